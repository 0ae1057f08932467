// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/scene/complete_scene.h>
#include <touchstone/scene/scene.h>

#include <filesystem>
#include <regex>
#include <sstream>

namespace Touchstone
{
  std::string
  complete_scene(const Scene &scene, const std::string &folder)
  {
    std::stringstream listing;
    scene.print(listing);
    // Behind the name ParameterHandler writes blanks and '# default: '.
    const std::regex file_entry("( *set File +=) *([^# ][^#]*?) *(#.*)?");
    std::string      result;
    for (std::string line; std::getline(listing, line);)
      {
        if (std::smatch match; std::regex_match(line, match, file_entry))
          line = match.str(1) + " " +
                 std::filesystem::absolute(std::filesystem::path(folder) / match.str(2))
                   .lexically_normal()
                   .string();
        result += line + "\n";
      }
    return result;
  }
} // namespace Touchstone
