// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/base/parameter_checks.h>

#include <deal.II/base/patterns.h>

namespace Touchstone
{
  void
  check_positive(const std::string &section,
                 const std::string &key,
                 const double       value,
                 const std::string &remedy)
  {
    // deal.II's Patterns::Double has inclusive bounds and cannot exclude zero.
    if (value <= 0.)
      throw InputError(
        section, key, dealii::Patterns::Tools::to_string(value), "must be positive", remedy);
  }
} // namespace Touchstone
