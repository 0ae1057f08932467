// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/json.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <locale>
#include <sstream>

/**
 * @file
 * A JSON value for output: objects keep the order in which members were set, so that files of two
 * runs can be compared line by line. There is no parser: the program writes JSON and reads none.
 */

namespace Touchstone
{
  namespace
  {
    /** A string with the escapes that JSON demands (RFC 8259, section 7). */
    std::string
    quoted(const std::string &text)
    {
      std::string result = "\"";
      for (const char c : text)
        switch (c)
          {
            case '"':
              result += "\\\"";
              break;
            case '\\':
              result += "\\\\";
              break;
            case '\n':
              result += "\\n";
              break;
            case '\t':
              result += "\\t";
              break;
            case '\r':
              result += "\\r";
              break;
            default:
              if (static_cast<unsigned char>(c) < 0x20)
                {
                  char code[8];
                  std::snprintf(code, sizeof(code), "\\u%04x", static_cast<unsigned int>(c));
                  result += code;
                }
              else
                result += c;
          }
      return result + "\"";
    }
  } // namespace



  Json::Json(const Kind kind)
    : kind(kind)
  {
  }



  Json::Json(const std::string &value)
    : kind(Kind::string)
    , text(value)
  {
  }



  Json::Json(const char *value)
    : Json(std::string(value))
  {
  }



  Json::Json(const dealii::Tensor<1, 3> &value)
    : kind(Kind::array)
  {
    for (unsigned int d = 0; d < 3; ++d)
      append(value[d]);
  }



  Json
  Json::object()
  {
    return Json(Kind::object);
  }



  Json
  Json::array()
  {
    return Json(Kind::array);
  }



  Json &
  Json::set(const std::string &key, const Json &value)
  {
    Assert(kind == Kind::object, dealii::ExcMessage("Only an object has members."));
    // Linear search: objects have few members, and their order is that of insertion.
    const auto member = std::find_if(members.begin(), members.end(), [&key](const auto &m) {
      return m.first == key;
    });
    if (member != members.end())
      member->second = value;
    else
      members.emplace_back(key, value);
    return *this;
  }



  Json &
  Json::append(const Json &value)
  {
    Assert(kind == Kind::array, dealii::ExcMessage("Only an array has elements."));
    members.emplace_back(std::string(), value);
    return *this;
  }



  std::string
  Json::print(const unsigned int max_digits) const
  {
    return print(max_digits, 0) + "\n";
  }



  std::string
  Json::print(const unsigned int max_digits, const unsigned int level) const
  {
    // Scalars first; arrays and objects, which are printed recursively, share the code below.
    switch (kind)
      {
        case Kind::boolean:
          return number != 0. ? "true" : "false";
        case Kind::literal:
          return text;
        case Kind::string:
          return quoted(text);
        case Kind::number:
          // JSON has no NaN and no infinity: they become null.
          if (std::isfinite(number))
            {
              std::ostringstream out;
              // A decimal comma of the user's locale would not be JSON.
              out.imbue(std::locale::classic());
              out << std::setprecision(max_digits) << number;
              return out.str();
            }
          return "null";
        case Kind::null:
          return "null";
        default:
          break;
      }

    const bool is_object = (kind == Kind::object);
    // Arrays of numbers are printed on one line, objects and nested arrays with one member per
    // line.
    const bool one_line =
      members.empty() ||
      (!is_object && std::none_of(members.begin(), members.end(), [](const auto &m) {
        return m.second.kind == Kind::array || m.second.kind == Kind::object;
      }));
    const std::string line_break = one_line ? "" : "\n" + std::string(2 * level + 2, ' ');

    std::string result = is_object ? "{" : "[";
    bool        first  = true;
    for (const auto &[key, value] : members)
      {
        if (!first)
          result += one_line ? ", " : ",";
        first = false;
        result += line_break;
        if (is_object)
          result += quoted(key) + ": ";
        result += value.print(max_digits, level + 1);
      }
    if (!one_line)
      result += "\n" + std::string(2 * level, ' ');
    return result + (is_object ? "}" : "]");
  }
} // namespace Touchstone
