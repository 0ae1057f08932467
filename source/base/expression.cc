// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/expression.h>
#include <touchstone/base/formula.h>
#include <touchstone/base/input_error.h>

#include <cmath>
#include <iostream>
#include <regex>
#include <sstream>

namespace Touchstone
{
  namespace
  {
    /** deal.II writes muParser's messages to std::cerr; catch them there. */
    class CaptureErrors
    {
    public:
      CaptureErrors()
        : before(std::cerr.rdbuf(text.rdbuf()))
      {
      }
      ~CaptureErrors()
      {
        std::cerr.rdbuf(before);
      }

      /** What muParser says is wrong. */
      std::string
      message() const
      {
        const std::string all = text.str();
        std::smatch       found;
        return std::regex_search(all, found, std::regex("Message: +<(.*)>"))
                 ? found[1].str()
                 : "it is not a formula";
      }

    private:
      std::ostringstream text;
      std::streambuf    *before;
    };

    /** muParser takes "1,5" for two formulas of which the last counts: the
     * decimal comma would be read as 5. */
    bool
    has_comma_outside_of_brackets(const std::string &expression)
    {
      int depth = 0;
      for (const char c : expression)
        {
          depth += (c == '(') - (c == ')');
          if (c == ',' && depth == 0)
            return true;
        }
      return false;
    }
  } // namespace



  void
  check_expression(const std::string &section,
                   const std::string &key,
                   const std::string &expression,
                   const std::string &variables)
  {
    const std::string remedy =
      "give a formula in the variables " + variables + " and the constant pi, for example '-0.1*t'";
    if (has_comma_outside_of_brackets(expression))
      throw InputError(section,
                       key,
                       expression,
                       "there is a comma outside of brackets",
                       "write decimals with a point");
    if (expression.find(';') != std::string::npos)
      throw InputError(section, key, expression, "these are several formulas", remedy);

    double value = 0.;
    {
      const CaptureErrors errors;
      try
        {
          value = Formula(section, key, expression).value(dealii::Point<dim>(0.3, 0.4, 0.6), 0.5);
        }
      catch (const std::exception &)
        {
          throw InputError(
            section, key, expression, "this formula cannot be read: " + errors.message(), remedy);
        }
    }

    const std::regex any_variable("\\b[xyzt]\\b");
    for (auto variable = std::sregex_iterator(expression.begin(), expression.end(), any_variable);
         variable != std::sregex_iterator();
         ++variable)
      if (variables.find(variable->str()) == std::string::npos)
        throw InputError(
          section, key, expression, "this formula must not depend on " + variable->str(), remedy);

    // Where a formula that depends on place or time must be defined the mesh decides, and
    // the steps: Formulas::check().
    if (!std::regex_search(expression, any_variable) && !std::isfinite(value))
      throw InputError(section, key, expression, "this is not a finite number", remedy);
  }
} // namespace Touchstone
