// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/mesh_text.h>

#include <charconv>
#include <cmath>

// Words and numbers of mesh files with the line where they stand, for messages that lead to the
// damage. The characters come straight from the stream buffer, as formatted input of streams is
// slow and lenient.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Whether all of @p word is a number. Unlike streams, this does not read the front of a
     * damaged word, nor "-1" as a large number without sign. */
    template <typename Number>
    bool
    parse(const std::string &word, Number &value)
    {
      const char *first = word.data(), *last = first + word.size();
      if (first != last && *first == '+')
        ++first;
      const auto [end, error] = std::from_chars(first, last, value);
      return error == std::errc() && end == last && end != first;
    }

    bool
    is_blank(const int c)
    {
      return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
    }
  } // namespace



  const char *const MeshFileError::default_remedy =
    "save the mesh again, with hexahedra of order 1 or 2, in ASCII.";

  MeshFileError::MeshFileError(const std::string &problem, std::string remedy)
    : std::runtime_error(problem)
    , remedy(std::move(remedy))
  {
  }

  MeshFileError::MeshFileError(const unsigned int line,
                               const std::string &problem,
                               std::string        remedy)
    : std::runtime_error("Line " + std::to_string(line) + ": " + problem)
    , remedy(std::move(remedy))
  {
  }


  MeshFileError
  surface_error(const std::string &element)
  {
    return MeshFileError(element + " is no quadrilateral, and so not the face of a hexahedron.",
                         "mesh the surface with quadrilaterals, or save the file without it");
  }



  unsigned long
  whole_number(const std::string &word)
  {
    unsigned long value = 0;
    if (!parse(word, value))
      throw MeshFileError("'" + word + "' stands where a whole number should.");
    return value;
  }



  double
  finite_number(const std::string &word)
  {
    double value = 0.;
    if (!parse(word, value) || !std::isfinite(value))
      throw MeshFileError("'" + word + "' stands where a coordinate should.");
    return value;
  }



  MeshText::MeshText(std::istream &in)
    : in(in)
  {
  }



  /** Skip white space and count the lines; the next character stays in the stream. */
  int
  MeshText::next_character()
  {
    std::streambuf &buffer = *in.rdbuf();
    int             c      = buffer.sgetc();
    for (; c == '\n' || is_blank(c); c = buffer.snextc())
      current_line += c == '\n';
    return c;
  }



  bool
  MeshText::word(std::string &text)
  {
    // The line of a word is kept apart from the current one: the latter has moved on when an
    // error of the word is found.
    std::streambuf &buffer = *in.rdbuf();
    constexpr int   end    = std::char_traits<char>::eof();
    text.clear();
    int c        = next_character();
    line_of_word = current_line;
    for (; c != end && c != '\n' && !is_blank(c); c = buffer.snextc())
      text.push_back(static_cast<char>(c));
    return !text.empty();
  }



  std::string
  MeshText::text(const char *what)
  {
    std::string result;
    if (!word(result))
      fail_in(what);
    return result;
  }



  unsigned long
  MeshText::number(const char *what)
  {
    const std::string next  = text(what);
    unsigned long     value = 0;
    if (!parse(next, value))
      fail("'" + next + "' stands in " + what + " where a whole number should.");
    return value;
  }



  long
  MeshText::signed_number(const char *what)
  {
    // Gmsh gives a negative sign to groups and entities of reversed orientation.
    const std::string next  = text(what);
    long              value = 0;
    if (!parse(next, value))
      fail("'" + next + "' stands in " + what + " where a whole number should.");
    return value;
  }



  double
  MeshText::real(const char *what)
  {
    // Infinite numbers and NaN parse, but make no mesh.
    const std::string next  = text(what);
    double            value = 0.;
    if (!parse(next, value) || !std::isfinite(value))
      fail("'" + next + "' stands in " + what + " where a number should.");
    return value;
  }



  Point<3>
  MeshText::point(const char *what)
  {
    Point<3> x;
    for (unsigned int d = 0; d < 3; ++d)
      x[d] = real(what);
    return x;
  }



  /** A number of entries that is about to be allocated. Each entry takes at least two characters,
   * a digit and a blank, so that damaged numbers are found before memory is exhausted. */
  unsigned int
  MeshText::announced(const char *what)
  {
    return announced(what, number(what));
  }



  unsigned int
  MeshText::announced(const char *what, const unsigned long n) const
  {
    // The bound comes from the number of bytes to the end of the file.
    const auto here = in.tellg();
    in.seekg(0, std::ios::end);
    const auto left = in.tellg() - here;
    in.seekg(here);
    if (n > static_cast<unsigned long>(left) / 2)
      fail(std::string(what) + " announces " + std::to_string(n) +
           " entries, more than the file can hold.");
    return n;
  }



  void
  MeshText::bytes(void *to, const std::size_t n, const char *what)
  {
    const auto read = in.rdbuf()->sgetn(static_cast<char *>(to), static_cast<std::streamsize>(n));
    if (read != static_cast<std::streamsize>(n))
      fail_in(what);
  }



  std::string
  MeshText::rest_of_line()
  {
    // The end of the line is not consumed, so that next_line() and the counting of lines stay
    // right.
    std::streambuf &buffer = *in.rdbuf();
    std::string     text;
    for (int c = buffer.sgetc(); c != std::char_traits<char>::eof() && c != '\n';
         c     = buffer.snextc())
      text.push_back(static_cast<char>(c));
    return text;
  }



  void
  MeshText::next_line()
  {
    rest_of_line();
    if (in.rdbuf()->sbumpc() == '\n')
      ++current_line;
  }



  /** Whether only blanks are left on the line; blanks are skipped. */
  bool
  MeshText::at_end_of_line()
  {
    std::streambuf &buffer = *in.rdbuf();
    int             c      = buffer.sgetc();
    while (is_blank(c))
      c = buffer.snextc();
    return c == '\n' || c == std::char_traits<char>::eof();
  }



  void
  MeshText::fail(const std::string &problem, const std::string &remedy) const
  {
    // The line is that of the last word, where the reader found the problem.
    throw MeshFileError(line_of_word,
                        problem,
                        remedy.empty() ? MeshFileError::default_remedy : remedy);
  }



  void
  MeshText::fail_in(const char *what) const
  {
    fail(std::string("The file ends, or is damaged, in ") + what + ".");
  }
} // namespace Touchstone
