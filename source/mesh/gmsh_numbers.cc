// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/gmsh_numbers.h>

#include <cmath>
#include <cstdint>

namespace Touchstone
{
  void
  GmshNumbers::read_format()
  {
    const char *section = "$MeshFormat";
    format              = text.real(section);
    has_bytes           = text.number(section) != 0;
    if (!((format >= 2. && format < 3.) || (format >= 4.1 && format < 5.)))
      text.fail("The format is version " + std::to_string(format) +
                "; save it as version 2.2 or 4.1.");
    const auto size_of_real = text.number(section);
    if (!has_bytes)
      return;
    if (format < 3.)
      text.fail("The file is binary and of version 2.",
                "save it in binary as version 4.1, or as ASCII");
    if (size_of_real != sizeof(double))
      text.fail("The file is binary with numbers of " + std::to_string(size_of_real) +
                  " bytes, not 8.",
                "save the mesh again on a machine of 64 bits");
    text.next_line();
    int one = 0;
    text.bytes(&one, sizeof(one), section);
    if (one != 1)
      text.fail("The file is binary, with bytes in another order than this machine has.",
                "save the mesh as ASCII");
  }



  template <class T>
  T
  GmshNumbers::value(const char *section)
  {
    T result = 0;
    text.bytes(&result, sizeof(result), section);
    return result;
  }



  unsigned long
  GmshNumbers::size(const char *section)
  {
    return has_bytes ? value<std::uint64_t>(section) : text.number(section);
  }



  long
  GmshNumbers::integer(const char *section)
  {
    return has_bytes ? value<std::int32_t>(section) : text.signed_number(section);
  }



  double
  GmshNumbers::real(const char *section)
  {
    const double result = has_bytes ? value<double>(section) : text.real(section);
    if (!std::isfinite(result))
      text.fail(std::string("A number in ") + section + " is not finite.");
    return result;
  }



  unsigned long
  GmshNumbers::tag(const char *section)
  {
    if (!has_bytes)
      return text.number(section);
    const long result = integer(section);
    if (result < 0)
      text.fail(std::string("A number in ") + section + " is negative.");
    return result;
  }
} // namespace Touchstone
