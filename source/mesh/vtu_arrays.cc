// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/mesh_text.h>
#include <touchstone/mesh/vtu_arrays.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <istream>
#include <iterator>
#include <sstream>
#include <zlib.h>

// Just enough of XML and of VTK's encodings: elements with attributes, no entities. An array of
// bytes has a head, the number of its bytes or, if it is compressed, the numbers and sizes of its
// blocks; in base64 the head of compressed arrays is encoded by itself.
namespace Touchstone
{
  namespace
  {
    [[noreturn]] void
    damaged(const std::string &what)
    {
      throw MeshFileError("The file ends, or is damaged, in " + what + ".",
                          "save the mesh again as an UnstructuredGrid (.vtu)");
    }



    /** An element of XML that begins at @p at, and where it ends. */
    struct Element
    {
      std::string                        name;
      std::map<std::string, std::string> attributes;
      std::size_t                        end    = 0;
      bool                               closed = false;
    };



    Element
    element_at(const std::string &text, const std::size_t at)
    {
      Element           result;
      const std::size_t stop = text.find('>', at);
      if (stop == std::string::npos)
        damaged("an element of XML");
      result.end             = stop + 1;
      std::string inside     = text.substr(at + 1, stop - at - 1);
      result.closed          = !inside.empty() && inside.back() == '/';
      const std::size_t name = std::min(inside.find_first_of(" \t\r\n/", 1), inside.size());
      result.name            = inside.substr(0, name);
      for (std::size_t i = name;;)
        {
          const std::size_t equals = inside.find('=', i);
          if (equals == std::string::npos)
            break;
          const std::size_t first = inside.find_first_not_of(" \t\r\n", i),
                            open  = inside.find_first_of("\"'", equals);
          if (open == std::string::npos)
            damaged("<" + result.name + ">");
          const std::size_t close = inside.find(inside[open], open + 1);
          if (close == std::string::npos)
            damaged("<" + result.name + ">");
          std::string key = inside.substr(first, equals - first);
          key.erase(key.find_last_not_of(" \t\r\n") + 1);
          result.attributes[key] = inside.substr(open + 1, close - open - 1);
          i                      = close + 1;
        }
      return result;
    }



    std::string
    attribute(const std::map<std::string, std::string> &attributes, const std::string &key)
    {
      const auto found = attributes.find(key);
      return found != attributes.end() ? found->second : "";
    }



    /** Decode base64 from @p at up to the first character that does not belong to it; padding
     * ends a part, another may follow. At most @p n bytes.
     * @return The bytes; @p at is moved behind the characters that were used. */
    std::string
    base64(const std::string &text, std::size_t &at, const std::size_t n)
    {
      static const std::string digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
      static const auto value = [] {
        std::array<int, 256> result;
        result.fill(-1);
        for (unsigned int i = 0; i < 64; ++i)
          result[static_cast<unsigned char>(digits[i])] = i;
        return result;
      }();
      std::string bytes;
      while (bytes.size() < n)
        {
          std::uint32_t group   = 0;
          unsigned int  padding = 0;
          for (unsigned int i = 0; i < 4; ++i, ++at)
            {
              if (at >= text.size())
                damaged("an array in base64");
              const int v = value[static_cast<unsigned char>(text[at])];
              if (v < 0 && !(text[at] == '=' && i >= 2))
                damaged("an array in base64");
              padding += v < 0;
              group = group << 6 | (v < 0 ? 0u : static_cast<std::uint32_t>(v));
            }
          for (unsigned int i = 0; i < 3 - padding; ++i)
            bytes.push_back(static_cast<char>(group >> (16 - 8 * i) & 255));
          if (padding > 0)
            break;
        }
      if (bytes.size() < n)
        damaged("an array in base64");
      bytes.resize(n);
      return bytes;
    }



    /** Numbers of one type from bytes. */
    template <typename Number>
    void
    convert(const std::string &bytes, std::vector<double> &values)
    {
      if (bytes.size() % sizeof(Number) != 0)
        damaged("an array of bytes");
      for (std::size_t i = 0; i < bytes.size(); i += sizeof(Number))
        {
          Number number;
          std::memcpy(&number, bytes.data() + i, sizeof(Number));
          values.push_back(static_cast<double>(number));
        }
    }



    void
    convert(const std::string &type, const std::string &bytes, std::vector<double> &values)
    {
      if (type == "Float64")
        convert<double>(bytes, values);
      else if (type == "Float32")
        convert<float>(bytes, values);
      else if (type == "Int64")
        convert<std::int64_t>(bytes, values);
      else if (type == "UInt64")
        convert<std::uint64_t>(bytes, values);
      else if (type == "Int32")
        convert<std::int32_t>(bytes, values);
      else if (type == "UInt32")
        convert<std::uint32_t>(bytes, values);
      else if (type == "Int16")
        convert<std::int16_t>(bytes, values);
      else if (type == "UInt16")
        convert<std::uint16_t>(bytes, values);
      else if (type == "Int8")
        convert<std::int8_t>(bytes, values);
      else if (type == "UInt8")
        convert<std::uint8_t>(bytes, values);
      else
        throw MeshFileError("The file has an array of type '" + type + "'.");
    }
  } // namespace



  VtuArrays::VtuArrays(std::istream &in)
    : text(std::istreambuf_iterator<char>(in), {})
  {
    read_file();
    text.clear();
    text.shrink_to_fit();
  }



  void
  VtuArrays::read_file()
  {
    // Appended bytes may look like XML and come last: they begin behind an underscore.
    std::size_t stop = text.find("<AppendedData");
    if (stop != std::string::npos)
      {
        const Element head = element_at(text, stop);
        appended           = text.find('_', head.end);
        appended_encoding  = attribute(head.attributes, "encoding");
        if (appended == std::string::npos)
          damaged("AppendedData");
        ++appended;
      }
    stop = std::min(stop, text.size());

    std::string  section;
    unsigned int pieces = 0;
    bool         is_vtu = false;
    // Elements that have begun and not ended: a file that lacks one of these is damaged.
    std::vector<std::string> open;
    for (std::size_t at = text.find('<'); at < stop;)
      {
        const Element element = element_at(text, at);
        if (element.name == "VTKFile")
          {
            file   = element.attributes;
            is_vtu = attribute(file, "type") == "UnstructuredGrid";
            if (attribute(file, "byte_order") == "BigEndian")
              throw MeshFileError("The bytes of the file are in another order than this machine's.",
                                  "save the mesh with byte order LittleEndian, or in ASCII");
          }
        else if (!is_vtu && element.name[0] != '?' && element.name[0] != '!')
          throw MeshFileError("The file does not begin with <VTKFile type=\"UnstructuredGrid\">.",
                              "save the mesh again as an UnstructuredGrid (.vtu)");
        else if (element.name == "Piece")
          {
            if (++pieces > 1)
              throw MeshFileError("The file has several pieces, whose common nodes are not joined.",
                                  "save the mesh again as one piece");
            points = whole_number(attribute(element.attributes, "NumberOfPoints"));
            cells  = whole_number(attribute(element.attributes, "NumberOfCells"));
          }
        else if (element.name == "Points" || element.name == "Cells" ||
                 element.name == "PointData" || element.name == "CellData")
          section = element.closed ? "" : element.name;
        else if (element.name[0] == '/' && element.name.substr(1) == section)
          section.clear();
        else if (element.name == "DataArray" && !section.empty())
          read_array(section, element.attributes, element.end);
        if (element.name[0] == '/')
          {
            if (open.empty() || open.back() != element.name.substr(1))
              damaged("<" + element.name + ">");
            open.pop_back();
          }
        else if (!element.closed && element.name[0] != '?' && element.name[0] != '!')
          open.push_back(element.name);
        at = text.find('<', element.end);
      }
    if (!open.empty() && stop == text.size())
      damaged("<" + open.back() + ">, which does not end");
    if (!is_vtu || pieces == 0)
      throw MeshFileError("The file has no UnstructuredGrid with a Piece.",
                          "save the mesh again as an UnstructuredGrid (.vtu)");
  }



  void
  VtuArrays::read_array(const std::string &section,
                        const Attributes  &array,
                        const std::size_t  begin)
  {
    const std::string name   = section == "Points" ? "" : attribute(array, "Name");
    const std::string format = attribute(array, "format"), type = attribute(array, "type");
    const std::string components = attribute(array, "NumberOfComponents");
    // Vectors and strings mean nothing here.
    if ((section == "PointData" || section == "CellData") &&
        ((!components.empty() && components != "1") || type == "String"))
      return;
    if (section == "Points" && !components.empty() && components != "3")
      throw MeshFileError("The points of the file have '" + components + "' coordinates each.");
    std::vector<double> numbers;
    if (format == "ascii")
      {
        convert(type, "", numbers); // refuses types that there are not
        const std::size_t  end = text.find('<', begin);
        std::istringstream in(text.substr(begin, end - begin));
        for (std::string word; in >> word;)
          numbers.push_back(finite_number(word));
      }
    else if (format == "binary")
      {
        const std::size_t first = text.find_first_not_of(" \t\r\n", begin);
        convert(type, decode(first, true), numbers);
      }
    else if (format == "appended" && appended > 0)
      convert(type,
              decode(appended + whole_number(attribute(array, "offset")),
                     appended_encoding == "base64"),
              numbers);
    else
      throw MeshFileError("The file has an array of format '" + format + "'" +
                          (format == "appended" ? ", but no AppendedData." : "."));
    if (!values.insert({{section, name}, numbers}).second)
      throw MeshFileError("The file has a second array '" + name + "' in " + section + ".");
  }



  std::string
  VtuArrays::decode(const std::size_t begin, const bool is_base64) const
  {
    std::size_t at   = begin;
    const auto  take = [&](const std::size_t n) {
      // No array has more bytes than the file, but compressed ones, which come by blocks.
      if (at > text.size() || n > text.size() - at)
        damaged("an array of bytes");
      if (is_base64)
        return base64(text, at, n);
      at += n;
      return text.substr(at - n, n);
    };
    const std::size_t width = attribute(file, "header_type") == "UInt64" ? 8 : 4;
    const auto        whole = [&](const std::string &bytes, const std::size_t i) {
      std::uint64_t value = 0;
      std::memcpy(&value, bytes.data() + i * width, width);
      return static_cast<std::size_t>(value);
    };

    const std::string compressor = attribute(file, "compressor");
    if (compressor.empty())
      {
        // In base64 head and bytes are one part.
        const std::size_t start = at;
        const std::size_t n     = whole(take(width), 0);
        if (!is_base64)
          return take(n);
        at = start;
        if (n > text.size())
          damaged("an array of bytes");
        return take(width + n).substr(width);
      }
    if (compressor != "vtkZLibDataCompressor")
      throw MeshFileError("The file is compressed by " + compressor + ".",
                          "save the mesh compressed by zlib, or not at all");

    // Blocks, the size of each and of the last, and their compressed sizes.
    const std::size_t start  = at;
    std::size_t       blocks = whole(take(3 * width), 0);
    if (blocks == 0)
      return "";
    if (blocks > text.size())
      damaged("a compressed array");
    at                     = start;
    const std::string head = take((3 + blocks) * width);
    const std::size_t size = whole(head, 1), last = whole(head, 2);
    std::size_t       sum = 0;
    for (std::size_t b = 0; b < blocks; ++b)
      sum += whole(head, 3 + b);
    const std::string packed = take(sum);
    std::string       result;
    for (std::size_t b = 0, from = 0; b < blocks; ++b)
      {
        const std::size_t n = b + 1 == blocks && last > 0 ? last : size, of = whole(head, 3 + b);
        // zlib packs by a factor of 1032 at most.
        if (n / 1100 > of || of > packed.size() - from)
          damaged("a compressed array");
        std::string block(n, '\0');
        uLongf      length = n;
        if (uncompress(reinterpret_cast<Bytef *>(&block[0]),
                       &length,
                       reinterpret_cast<const Bytef *>(packed.data() + from),
                       of) != Z_OK ||
            length != n)
          damaged("a compressed array");
        result += block;
        from += of;
      }
    return result;
  }



  const std::vector<double> *
  VtuArrays::find(const std::string &section, const std::string &name) const
  {
    const auto found = values.find({section, name});
    return found != values.end() ? &found->second : nullptr;
  }



  std::string
  VtuArrays::names() const
  {
    std::string result;
    for (const auto &[key, numbers] : values)
      if (key.first == "PointData" || key.first == "CellData")
        result += (result.empty() ? "'" : ", '") + key.second + "'";
    return result.empty() ? "none" : result;
  }
} // namespace Touchstone
