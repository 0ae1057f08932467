// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/statistics_csv.h>

#include <algorithm>
#include <charconv>
#include <utility>

namespace Touchstone
{
  namespace
  {
    /** Units of the built-in values, by the end of their names; the longer ones first. Those of
     * extensions are not known. */
    const std::vector<std::pair<std::string, std::string>> units = {
      {"angular momentum", "force*length*time"},
      {"momentum", "force*time"},
      {"moment", "force*length"},
      {"shortest cycle", "time"},
      {"displacement", "length"},
      {"rotation", "degrees"},
      {"angular velocity", "radians/time"},
      {"velocity", "length/time"},
      {"step size", "time"},
      {"time", "time"},
      {"force", "force"},
      {"reaction", "force"},
      {"area", "length^2"},
      {"max pressure", "force/length^2"},
      {"max penetration", "length"},
      {"shortening", "length"},
      {"tension", "force"}};

    std::string
    unit(const std::string &name)
    {
      if (name.compare(0, 8, "energy: ") == 0)
        return "[force*length]";
      for (const auto &[end, unit] : units)
        if (name.size() >= end.size() &&
            name.compare(name.size() - end.size(), end.size(), end) == 0)
          return "[" + unit + "]";
      return "";
    }

    /** One word, which programs can take for a name, and no comma or quotation mark. */
    std::string
    one_word(const std::string &name)
    {
      std::string result;
      for (std::size_t i = 0; i < name.size(); ++i)
        if (name[i] == ':' || name[i] == '/')
          {
            result += '.';
            i += i + 1 < name.size() && name[i + 1] == ' ';
          }
        else
          result +=
            name[i] == ' ' || name[i] == ',' || name[i] == ';' || name[i] == '"' ? '_' : name[i];
      return result;
    }
  } // namespace



  std::string
  all_digits(const double value)
  {
    char       text[32];
    const auto end = std::to_chars(text, text + sizeof(text), value).ptr;
    return {text, end};
  }



  void
  StatisticsCsv::begin_row()
  {
    rows.emplace_back();
  }



  void
  StatisticsCsv::add(const StepValue &value)
  {
    const std::string name =
      one_word(value.pair.empty() ? value.name : value.pair + ": " + value.name);
    for (unsigned int d = 0; d < (value.kind == StepValue::vector ? 3U : 1U); ++d)
      {
        const std::string column =
          name + (value.kind == StepValue::vector ? std::string("_") + "xyz"[d] : "") +
          (value.kind == StepValue::count ? "" : unit(value.name));
        if (std::find(columns.begin(), columns.end(), column) == columns.end())
          columns.push_back(column);
        rows.back()[column] = value.components[d];
      }
  }



  std::string
  StatisticsCsv::text() const
  {
    std::string result;
    for (const std::string &column : columns)
      result += (result.empty() ? "" : ",") + column;
    result += '\n';
    for (const auto &row : rows)
      {
        std::string line;
        for (std::size_t c = 0; c < columns.size(); ++c)
          {
            const auto value = row.find(columns[c]);
            line += (c == 0 ? "" : ",") + (value == row.end() ? "" : all_digits(value->second));
          }
        result += line + '\n';
      }
    return result;
  }
} // namespace Touchstone
