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
    /**
     * deal.II prints muParser's messages to std::cerr before it throws. They are captured while
     * this object lives, to become part of the InputError.
     */
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

      /** muParser's description of the error, without deal.II's frame around it. */
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

    /**
     * muParser takes "1,5" for two expressions of which the last one counts: a decimal comma would
     * be read as 5 without an error. Commas between arguments, inside brackets, are allowed.
     */
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



  std::string
  FormulaPattern::description(const OutputStyle) const
  {
    return "[Formula]";
  }



  std::unique_ptr<dealii::Patterns::PatternBase>
  FormulaPattern::clone() const
  {
    return std::make_unique<FormulaPattern>();
  }



  std::optional<double>
  constant_value(const std::string &expression)
  {
    if (has_comma_outside_of_brackets(expression) || expression.find(';') != std::string::npos ||
        std::regex_search(expression, std::regex("\\b([xyzt]|rand|rand_seed)\\b")))
      return {};
    const CaptureErrors errors;
    try
      {
        const double value = Formula("", "", expression).value(dealii::Point<dim>(), 0.);
        return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
      }
    catch (const std::exception &)
      {
        return {};
      }
  }



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
    // deal.II's FunctionParser takes ';' as separator of components.
    if (expression.find(';') != std::string::npos)
      throw InputError(section, key, expression, "these are several formulas", remedy);

    // Evaluated once at an arbitrary point, since muParser finds some errors, such as unknown
    // names, at the first evaluation only.
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

    // x, y, z and t always exist in the parser. Where the position is not defined, e.g. for the
    // motion of a rigid obstacle, a formula of x would be evaluated at the origin without an error.
    const std::regex any_variable("\\b[xyzt]\\b");
    for (auto variable = std::sregex_iterator(expression.begin(), expression.end(), any_variable);
         variable != std::sregex_iterator();
         ++variable)
      if (variables.find(variable->str()) == std::string::npos)
        throw InputError(
          section, key, expression, "this formula must not depend on " + variable->str(), remedy);

    // A formula of position or time need not be finite at the arbitrary point above:
    // Formulas::check() judges it where it is evaluated. A constant is judged here.
    if (!std::regex_search(expression, any_variable) && !std::isfinite(value))
      throw InputError(section, key, expression, "this is not a finite number", remedy);
  }
} // namespace Touchstone
