// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_parameter_checks_h
#define touchstone_base_parameter_checks_h

#include <string>

namespace Touchstone
{
  /** @brief Refuse a number that is not greater than zero.
   * @throws InputError with @p section, @p key, the value and @p remedy. */
  void
  check_positive(const std::string &section,
                 const std::string &key,
                 double             value,
                 const std::string &remedy);
} // namespace Touchstone

#endif
