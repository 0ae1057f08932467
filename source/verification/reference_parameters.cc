// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/expression.h>
#include <touchstone/base/input_error.h>
#include <touchstone/verification/reference_parameters.h>

#include <deal.II/base/utilities.h>

#include <cmath>

namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  void
  ReferenceParameters::declare(ParameterHandler &prm, const EarlyValues &values_set)
  {
    type.choose(values_set, "Type");
    prm.add_parameter("Type",
                      type.name,
                      "The exact solution that the result is compared with; 'none' "
                      "compares with nothing.",
                      Patterns::Anything());
    prm.add_parameter("Pair",
                      pair,
                      "The contact pair that is compared; empty: the first.",
                      Patterns::Anything());
    prm.add_parameter("Values",
                      values,
                      "Named numbers that the type asks for, for example "
                      "'radius: 10, pressure: 5'.",
                      Patterns::Anything());
    prm.add_parameter("Pressure",
                      pressure,
                      "Contact pressure that the result is compared with if the type is "
                      "'formula', a formula in x, y, z (reference coordinates of the slave "
                      "surface) and t; empty: not compared. [force per reference area]",
                      FormulaPattern());
    type.declare_own_keys(prm);
  }



  std::map<std::string, double>
  ReferenceParameters::numbers(const std::string &section) const
  {
    std::map<std::string, double> result;
    for (const std::string &item : dealii::Utilities::split_string_list(values, ','))
      {
        const std::size_t colon = item.find(':');
        const std::string name  = dealii::Utilities::trim(item.substr(0, colon));
        // An item without a number stays NaN and is refused below, with the same message as one
        // that cannot be read.
        double value = std::nan("");
        // Numbers of C in base 16 are no numbers of scenes.
        if (colon != std::string::npos && item.find_first_of("xX", colon) == std::string::npos)
          try
            {
              value = dealii::Utilities::string_to_double(item.substr(colon + 1));
            }
          catch (const std::exception &)
            {
            }
        if (name.empty() || !std::isfinite(value) || !result.emplace(name, value).second)
          throw InputError(section,
                           "Values",
                           item,
                           result.count(name) > 0 ? "this name is given twice"
                                                  : "this is not a name with a number",
                           "write 'name: number' with commas between them, for "
                           "example 'radius: 10, pressure: 5'");
      }
    return result;
  }



  void
  ReferenceParameters::check(const std::string &section) const
  {
    type.check(section);
    numbers(section);
    if (!pressure.empty())
      check_expression(section, "Pressure", pressure);
  }
} // namespace Touchstone
