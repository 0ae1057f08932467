// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/abaqus_lines.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace Touchstone
{
  std::string
  in_capitals(std::string text)
  {
    std::transform(text.begin(), text.end(), text.begin(), ::toupper);
    return text;
  }



  std::vector<std::string>
  split_abaqus(const std::string &line)
  {
    std::vector<std::string> words;
    std::istringstream       in(line);
    for (std::string word; std::getline(in, word, ',');)
      {
        const auto first = word.find_first_not_of(" \t\r"), last = word.find_last_not_of(" \t\r");
        words.push_back(first == std::string::npos ? "" : word.substr(first, last - first + 1));
      }
    while (!words.empty() && words.back().empty())
      words.pop_back();
    return words;
  }



  AbaqusKeyword::AbaqusKeyword(const std::string &line)
  {
    const std::vector<std::string> words = split_abaqus(line);
    name                                 = in_capitals(words[0]);
    for (unsigned int i = 1; i < words.size(); ++i)
      {
        const auto equals    = words[i].find('=');
        const bool has_value = equals != std::string::npos;
        const auto parameter = split_abaqus(words[i].substr(0, equals));
        auto       value     = split_abaqus(has_value ? words[i].substr(equals + 1) : "");
        value.resize(1);
        // Names with blanks stand between quotation marks.
        if (value[0].size() > 1 && value[0].front() == '"' && value[0].back() == '"')
          value[0] = value[0].substr(1, value[0].size() - 2);
        if (!parameter.empty())
          parameters[in_capitals(parameter[0])] = value[0];
      }
  }



  std::string
  AbaqusKeyword::value(const char *parameter) const
  {
    const auto found = parameters.find(parameter);
    return found == parameters.end() ? "" : found->second;
  }
} // namespace Touchstone
