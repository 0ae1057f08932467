// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/expression.h>
#include <touchstone/base/input_error.h>
#include <touchstone/base/suggestion.h>
#include <touchstone/scene/constants.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>

namespace Touchstone
{
  using dealii::Utilities::trim;

  namespace
  {
    /** Names that mean something in a formula already. */
    const std::set<std::string> reserved = {"x",     "y",     "z",    "t",        "pi",    "_pi",
                                            "_e",    "sin",   "cos",  "tan",      "asin",  "acos",
                                            "atan",  "atan2", "sinh", "cosh",     "tanh",  "asinh",
                                            "acosh", "atanh", "log",  "log2",     "log10", "ln",
                                            "exp",   "sqrt",  "cbrt", "sign",     "rint",  "abs",
                                            "min",   "max",   "sum",  "avg",      "if",    "int",
                                            "ceil",  "floor", "cot",  "csc",      "sec",   "pow",
                                            "erf",   "erfc",  "rand", "rand_seed"};

    bool
    starts_name(const char c)
    {
      return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
    }

    bool
    in_name(const char c)
    {
      return starts_name(c) || std::isdigit(static_cast<unsigned char>(c)) != 0;
    }

    /** Parts of a list with the separators between them, which do not count within brackets. */
    std::vector<std::string>
    split(const std::string &text, const std::string &separators)
    {
      std::vector<std::string> parts(1);
      int                      depth = 0;
      for (const char c : text)
        {
          depth += (c == '(') - (c == ')');
          if (depth == 0 && separators.find(c) != std::string::npos)
            {
              parts.emplace_back(1, c);
              parts.emplace_back();
            }
          else
            parts.back() += c;
        }
      return parts;
    }

    /** The fewest digits that read back to the same number, whatever the locale. */
    std::string
    shortest(const double value)
    {
      char       text[32];
      const auto end = std::to_chars(text, text + sizeof(text), value).ptr;
      return {text, end};
    }
  } // namespace



  void
  Constants::define(const std::string &list, const int depth, const std::string &location)
  {
    const auto refuse =
      [&](const std::string &what, const std::string &problem, const std::string &remedy = "") {
        throw InputError(
          "",
          "Constants",
          what,
          problem + " (" + location + ")",
          !remedy.empty()
            ? remedy
            : "write 'set Constants = NAME = EXPRESSION, NAME = EXPRESSION', where a name "
              "has letters, digits and '_' and means nothing else in a formula");
      };
    if (trim(list).empty())
      return;
    const std::vector<std::string> parts = split(list, ",");
    for (std::size_t i = 0; i < parts.size(); i += 2)
      {
        const std::string part   = trim(parts[i]);
        const std::size_t equals = part.find('=');
        if (equals == std::string::npos)
          refuse(part, part.empty() ? "a constant is missing" : "this constant has no value");
        const std::string name = trim(part.substr(0, equals)), text = trim(part.substr(equals + 1));
        if (name.empty() || !starts_name(name[0]) ||
            !std::all_of(name.begin(), name.end(), in_name))
          refuse(part, "this is no name for a constant");
        if (reserved.count(name) > 0)
          refuse(part, "'" + name + "' has a meaning of its own in formulas");
        if (text.empty())
          refuse(part, "this constant has no value");

        const auto other = find(name);
        if (!other)
          all.push_back({name, text, depth, location, depth >= 0, {}, false, {}, false});
        else if (all[*other].depth <= depth && depth >= 0)
          refuse(part,
                 "this constant is also defined in " + all[*other].location,
                 "keep one of them; a file may change a constant that it has included before, not "
                 "the other way round");
        else
          {
            all[*other].expression = text;
            all[*other].depth      = depth;
            all[*other].location   = location;
          }
      }
  }



  void
  Constants::evaluate()
  {
    for (std::size_t i = 0; i < all.size(); ++i)
      value(i);
  }



  double
  Constants::value(const std::size_t number)
  {
    Constant &constant = all[number];
    if (constant.value)
      return *constant.value;
    const auto refuse = [&](const std::string &problem, const std::string &remedy) {
      throw InputError("",
                       "Constants",
                       constant.name + " = " + constant.expression,
                       problem + " (" + constant.location + ")",
                       remedy);
    };
    if (constant.in_progress)
      refuse("this constant depends on itself", "give it a value that does not need it");

    constant.in_progress   = true;
    const std::string text = replace(constant.expression, [&](const std::size_t other) {
      constant.needs.push_back(other);
      return shortest(value(other));
    });
    constant.value         = constant_value(text);
    if (!constant.value)
      refuse("this is not a finite number",
             "give an expression in numbers, pi and the constants " + quoted_list(names()));
    constant.in_progress = false;
    return *constant.value;
  }



  std::string
  Constants::replace(const std::string                             &formula,
                     const std::function<std::string(std::size_t)> &text_of) const
  {
    std::string result;
    for (std::size_t i = 0; i < formula.size();)
      {
        std::size_t end = i + 1;
        if (starts_name(formula[i]))
          {
            while (end < formula.size() && in_name(formula[end]))
              ++end;
            const std::string name   = formula.substr(i, end - i);
            const auto        number = find(name);
            // In brackets: for signs, and so that "2R" stays an error and does not become 210.
            result += number ? '(' + text_of(*number) + ')' : name;
          }
        else if (std::isdigit(static_cast<unsigned char>(formula[i])) != 0 || formula[i] == '.')
          {
            // A number, whose exponent is no name.
            const auto digits = [&] {
              while (end < formula.size() &&
                     (std::isdigit(static_cast<unsigned char>(formula[end])) != 0 ||
                      formula[end] == '.'))
                ++end;
            };
            digits();
            if (end < formula.size() && (formula[end] == 'e' || formula[end] == 'E'))
              {
                const std::size_t sign =
                  end + 1 < formula.size() && (formula[end + 1] == '+' || formula[end + 1] == '-');
                if (end + 1 + sign < formula.size() &&
                    std::isdigit(static_cast<unsigned char>(formula[end + 1 + sign])) != 0)
                  {
                    end += 1 + sign;
                    digits();
                  }
              }
            result += formula.substr(i, end - i);
          }
        else
          result += formula[i];
        i = end;
      }
    return result;
  }



  std::string
  Constants::insert(const std::string &formula) const
  {
    return replace(formula, [this](const std::size_t number) {
      mark_used(number);
      return shortest(*all[number].value);
    });
  }



  std::optional<std::string>
  Constants::numbers(const std::string &text, const bool whole, const bool list) const
  {
    std::string                    result;
    const std::vector<std::string> parts = split(text, ",;");
    if (!list && parts.size() > 1)
      return {};
    for (std::size_t i = 0; i < parts.size(); ++i)
      {
        if (i % 2 == 1)
          {
            result += parts[i] + ' ';
            continue;
          }
        const std::optional<double> value = constant_value(insert(parts[i]));
        if (!value)
          return {};
        const double nearest = std::round(*value);
        // Round-off of a few operations; what is further away is no whole number.
        const bool is_whole =
          std::abs(*value - nearest) <= 1e-12 * std::abs(nearest) &&
          std::abs(nearest) <= static_cast<double>(std::numeric_limits<int>::max());
        result += whole && is_whole ? std::to_string(std::lround(nearest)) : shortest(*value);
      }
    return result;
  }



  std::vector<std::string>
  Constants::names() const
  {
    std::vector<std::string> result;
    for (const Constant &constant : all)
      result.push_back(constant.name);
    return result;
  }



  std::optional<std::size_t>
  Constants::find(const std::string &name) const
  {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].name == name)
        return i;
    return {};
  }



  void
  Constants::mark_used(const std::size_t number) const
  {
    if (all[number].used)
      return;
    all[number].used = true;
    for (const std::size_t other : all[number].needs)
      mark_used(other);
  }



  void
  Constants::check_used() const
  {
    std::vector<std::string> known;
    for (const Constant &constant : all)
      if (constant.in_file)
        known.push_back(constant.name);
    for (const Constant &constant : all)
      if (constant.depth < 0 && !constant.used)
        throw InputError("",
                         "Constants",
                         constant.name + " = " + constant.expression,
                         "nothing in the scene uses this constant (" + constant.location + ")",
                         known.empty()
                           ? "the scene has no constants; one that the program has printed has "
                             "numbers in their place"
                           : "the scene has the constants " + quoted_list(known));
  }
} // namespace Touchstone
