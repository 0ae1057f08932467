#include <touchstone/mesh/mesh_file.h>

#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** One pass through a .msh file, section by section. */
    class GmshReader
    {
    public:
      explicit GmshReader(std::istream &in)
        : in(in)
      {
      }

      MeshFile
      read();

    private:
      std::istream &in;
      MeshFile      mesh;
      double        version = 0.;

      /** Index of a node's number. */
      std::map<unsigned long, unsigned int> node;
      /** Physical groups of each surface (2) and volume (3) of version 4. */
      std::map<unsigned long, std::vector<unsigned int>> physical[4];
      /** Names of physical surfaces and volumes. */
      std::map<unsigned int, std::string> names[4];

      /** The next word as a number; an error if the file ends or has none. */
      template <typename Number>
      Number
      next(const char *what)
      {
        Number value;
        if (!(in >> value))
          throw std::runtime_error(std::string("The file ends, or is damaged, in ") + what + ".");
        return value;
      }

      void
      read_format();
      void
      read_names();
      void
      read_entities();
      void
      read_nodes();
      void
      read_elements();
      void
      read_node(unsigned long number);
      void
      read_element(unsigned int type, const std::vector<unsigned int> &groups);
    };



    MeshFile
    GmshReader::read()
    {
      bool        has_elements = false;
      std::string word;
      while (in >> word)
        {
          if (word == "$MeshFormat")
            read_format();
          else if (word == "$PhysicalNames")
            read_names();
          else if (word == "$Entities")
            read_entities();
          else if (word == "$Nodes")
            read_nodes();
          else if (word == "$Elements")
            {
              read_elements();
              has_elements = true;
            }
          else if (word[0] != '$')
            throw std::runtime_error("The word '" + word +
                                     "' stands where a section like "
                                     "$Nodes should begin.");
          // Whatever is left of the section, or all of one that is not needed.
          const std::string end = "$End" + word.substr(1);
          while (word != end)
            if (!(in >> word))
              throw std::runtime_error("The file ends before " + end + ".");
        }
      if (!has_elements)
        throw std::runtime_error("The file has no $Elements.");

      for (auto *groups : {&mesh.surfaces, &mesh.volumes})
        for (MeshFile::Group &group : *groups)
          group.name = names[groups == &mesh.surfaces ? 2 : 3][group.number];
      return std::move(mesh);
    }



    void
    GmshReader::read_format()
    {
      version           = next<double>("$MeshFormat");
      const bool binary = next<int>("$MeshFormat") != 0;
      if (binary)
        throw std::runtime_error("The file is binary; save it as ASCII.");
      if (!((version >= 2. && version < 3.) || (version >= 4.1 && version < 5.)))
        throw std::runtime_error("The format is version " + std::to_string(version) +
                                 "; save it as version 2.2 or 4.1.");
    }



    void
    GmshReader::read_names()
    {
      const auto n = next<unsigned int>("$PhysicalNames");
      for (unsigned int i = 0; i < n; ++i)
        {
          const auto  d      = next<unsigned int>("$PhysicalNames");
          const auto  number = next<unsigned int>("$PhysicalNames");
          std::string quoted;
          std::getline(in, quoted);
          const auto first = quoted.find('"'), last = quoted.rfind('"');
          if (d > 3 || first == last)
            throw std::runtime_error("$PhysicalNames is damaged.");
          names[d][number] = quoted.substr(first + 1, last - first - 1);
        }
    }



    void
    GmshReader::read_entities()
    {
      const char   *what = "$Entities";
      unsigned long n[4];
      for (unsigned long &count : n)
        count = next<unsigned long>(what);
      for (unsigned int d = 0; d < 4; ++d)
        for (unsigned long i = 0; i < n[d]; ++i)
          {
            const auto tag = next<unsigned long>(what);
            for (unsigned int b = 0; b < (d == 0 ? 3 : 6); ++b)
              next<double>(what);
            for (auto left = next<unsigned long>(what); left > 0; --left)
              physical[d][tag].push_back(std::abs(next<int>(what)));
            if (d > 0)
              for (auto left = next<unsigned long>(what); left > 0; --left)
                next<long>(what);
          }
    }



    void
    GmshReader::read_node(const unsigned long number)
    {
      Point<3> x;
      for (unsigned int d = 0; d < 3; ++d)
        x[d] = next<double>("$Nodes");
      node[number] = mesh.vertices.size();
      mesh.vertices.push_back(x);
    }



    void
    GmshReader::read_nodes()
    {
      const char *what = "$Nodes";
      const auto  n    = next<unsigned long>(what);
      if (version < 3.)
        {
          for (unsigned long i = 0; i < n; ++i)
            read_node(next<unsigned long>(what));
          return;
        }
      for (unsigned int i = 0; i < 3; ++i)
        next<unsigned long>(what); // number of nodes, smallest and largest tag
      for (unsigned long block = 0; block < n; ++block)
        {
          next<int>(what);
          next<long>(what);
          if (next<int>(what) != 0)
            throw std::runtime_error("The nodes have parametric coordinates; save the file "
                                     "without them.");
          const auto n_block = next<unsigned int>(what);
          if (n_block > MeshFile::bytes_left(in) / 2)
            throw std::runtime_error("The file ends, or is damaged, in $Nodes.");
          std::vector<unsigned long> numbers(n_block);
          for (unsigned long &number : numbers)
            number = next<unsigned long>(what);
          for (const unsigned long number : numbers)
            read_node(number);
        }
    }



    void
    GmshReader::read_elements()
    {
      const char *what = "$Elements";
      const auto  n    = next<unsigned long>(what);
      if (version < 3.)
        {
          for (unsigned long i = 0; i < n; ++i)
            {
              next<unsigned long>(what);
              const auto                type = next<unsigned int>(what);
              std::vector<unsigned int> tags(next<unsigned int>(what));
              for (unsigned int &tag : tags)
                tag = std::abs(next<int>(what));
              // The first tag is the physical group, or zero for none.
              tags.resize(tags.empty() || tags[0] == 0 ? 0 : 1);
              read_element(type, tags);
            }
          return;
        }
      for (unsigned int i = 0; i < 3; ++i)
        next<unsigned long>(what);
      for (unsigned long block = 0; block < n; ++block)
        {
          const auto d    = next<unsigned int>(what);
          const auto tag  = next<unsigned long>(what);
          const auto type = next<unsigned int>(what);
          if (d > 3)
            throw std::runtime_error("$Elements is damaged.");
          for (auto left = next<unsigned long>(what); left > 0; --left)
            {
              next<unsigned long>(what);
              read_element(type, physical[d][tag]);
            }
        }
    }



    void
    GmshReader::read_element(const unsigned int type, const std::vector<unsigned int> &groups)
    {
      // Elements of order one; the codes are those of the Gmsh manual.
      constexpr unsigned int quadrangle = 3, hexahedron = 5, edge = 1, triangle = 2, point = 15;
      if (type == 4 || type == 6 || type == 7)
        throw std::runtime_error("It has tetrahedra, prisms or pyramids.");
      const bool is_other = type == edge || type == triangle || type == point;
      if (type != quadrangle && type != hexahedron && !is_other)
        throw std::runtime_error("It has elements of Gmsh's type " + std::to_string(type) +
                                 ", perhaps of higher order; save it with order 1.");

      std::string line;
      std::getline(in, line);
      if (is_other)
        return;
      std::istringstream        words(line);
      std::vector<unsigned int> vertices;
      for (unsigned long number; words >> number;)
        {
          const auto found = node.find(number);
          if (found == node.end())
            throw std::runtime_error("An element uses node " + std::to_string(number) +
                                     ", which the file does not have.");
          vertices.push_back(found->second);
        }
      if (vertices.size() != (type == hexahedron ? 8 : 4))
        throw std::runtime_error("The file ends, or is damaged, in $Elements.");

      const bool is_cell = type == hexahedron;
      if (is_cell)
        mesh.add_cell(vertices);
      else
        mesh.faces.push_back({{vertices[0], vertices[1], vertices[2], vertices[3]}});
      for (const unsigned int number : groups)
        MeshFile::group(is_cell ? mesh.volumes : mesh.surfaces, number)
          .members.push_back((is_cell ? mesh.cells.size() : mesh.faces.size()) - 1);
    }
  } // namespace



  void
  MeshFile::add_cell(const std::vector<unsigned int> &v)
  {
    CellData<3> cell;
    cell.vertices = {v[0], v[1], v[3], v[2], v[4], v[5], v[7], v[6]};
    cells.push_back(cell);
  }



  std::size_t
  MeshFile::bytes_left(std::istream &in)
  {
    const auto here = in.tellg();
    in.seekg(0, std::ios::end);
    const auto end = in.tellg();
    in.seekg(here);
    return end > here ? static_cast<std::size_t>(end - here) : 0;
  }



  MeshFile::Group &
  MeshFile::group(std::vector<Group> &groups, const unsigned int number)
  {
    for (Group &group : groups)
      if (group.number == number)
        return group;
    groups.push_back({number, "", {}});
    return groups.back();
  }



  MeshFile
  read_gmsh(std::istream &in)
  {
    return GmshReader(in).read();
  }
} // namespace Touchstone
