// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_value_of_h
#define touchstone_contact_geometry_value_of_h

#include <Sacado.hpp>

namespace Touchstone
{
  /** @brief The value of a number that may carry derivatives. */
  inline double
  value_of(const double x)
  {
    return x;
  }

  template <int n>
  double
  value_of(const Sacado::Fad::SFad<double, n> &x)
  {
    return x.val();
  }
} // namespace Touchstone

#endif
