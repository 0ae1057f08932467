// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_abaqus_lines_h
#define touchstone_mesh_abaqus_lines_h

#include <map>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief The parts of a line between commas, without blanks around them. */
  std::vector<std::string>
  split_abaqus(const std::string &line);

  /**
   * @brief A keyword line, which rules the data lines up to the next one.
   *
   * Keywords and names of parameters are compared in capitals, as Abaqus does; blanks around
   * commas and equal signs do not count.
   */
  struct AbaqusKeyword
  {
    AbaqusKeyword() = default;
    explicit AbaqusKeyword(const std::string &line);

    bool
    has(const char *parameter) const
    {
      return parameters.count(parameter) > 0;
    }

    /** @brief The value of a parameter as written, without quotation marks around it; empty if it
     * is not there. */
    std::string
    value(const char *parameter) const;

    /** With the star, in capitals. */
    std::string name;

  private:
    std::map<std::string, std::string> parameters;
  };

  /** @brief The text in capitals. */
  std::string
  in_capitals(std::string text);
} // namespace Touchstone

#endif
