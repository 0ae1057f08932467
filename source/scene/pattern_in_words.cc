// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/suggestion.h>
#include <touchstone/scene/pattern_in_words.h>

#include <deal.II/base/utilities.h>

#include <regex>

// deal.II describes which values a key may have in its own terms; here they are in words.
namespace Touchstone
{
  using dealii::Utilities::split_string_list;

  namespace
  {
    /**
     * In words what deal.II's description of a pattern asks for, of a number or of several. Bounds
     * at the limits of the type are no bounds to the user; empty for other patterns.
     */
    std::string
    numbers_in_words(const std::string &pattern, const bool several)
    {
      std::smatch found;
      if (!std::regex_match(pattern,
                            found,
                            std::regex(R"(\[(Integer range|Double) (.*)\.\.\.(.*) \(incl.*)")))
        return "";
      const std::string low = found[2], high = found[3];
      const bool        from = low.find("MAX_") == std::string::npos && low != "-2147483648",
                 to          = high.find("MAX_") == std::string::npos && high != "2147483647";
      return std::string(several ? "" : "a ") + (found[1] == "Double" ? "" : "whole ") + "number" +
             (several ? "s" : "") +
             (from && to ? " from " + low + " to " + high
              : from     ? " of at least " + low
              : to       ? " of at most " + high
                         : "");
    }



    /** The same of lists, and of lists of points. */
    std::string
    list_in_words(const std::string &pattern)
    {
      std::smatch found;
      if (!std::regex_match(pattern,
                            found,
                            std::regex(
                              R"(\[List of <(.*)> of length (\d+)\.\.\.(\d+) \(inclusive\)(.*))")))
        return "";
      const std::string inner = found[1], least = found[2], most = found[3];
      if (inner.compare(0, 6, "[Tuple") == 0)
        return "pairs of numbers, with a colon in each and commas between them";
      std::string items = numbers_in_words(inner, true);
      if (inner.compare(0, 5, "[List") == 0)
        items = "points, each of " + list_in_words(inner) + ",";
      else if (items.empty())
        items = "words";
      // The limit of the type is none to the user.
      const bool        any   = most.size() >= 10;
      const std::string count = least == most         ? least + " "
                                : any && least == "0" ? ""
                                : any                 ? "at least " + least + " "
                                : least == "0"        ? "up to " + most + " "
                                                      : least + " to " + most + " ";
      return count + items + " with " +
             (found[4].str().find(';') == std::string::npos ? "commas" : "semicolons") +
             " between them";
    }
  } // namespace



  std::string
  remedy_for_pattern(const std::string &pattern, const std::string &value)
  {
    if (const std::string number = numbers_in_words(pattern, false); !number.empty())
      return "give " + number;
    if (const std::string list = list_in_words(pattern); !list.empty())
      return "give " + list;
    // For a choice of words the nearest word is suggested.
    std::smatch found;
    if (std::regex_match(pattern, found, std::regex(R"(\[Selection (.*?) ?\])")))
      {
        const auto names = split_string_list(found[1], '|');
        return "give one of " + quoted_list(names) + did_you_mean(value, names);
      }
    // Descriptions without a translation are shown as deal.II has them.
    if (pattern.compare(0, 5, "[Bool") == 0)
      return "give 'true' or 'false'";
    return "give " + pattern;
  }
} // namespace Touchstone
