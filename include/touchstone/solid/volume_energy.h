// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_volume_energy_h
#define touchstone_solid_volume_energy_h

#include <cmath>

namespace Touchstone
{
  /** @brief U = kappa/2 ((J^2 - 1)/2 - ln J), by @p I = J^2, the determinant of C: the energy of
   * volume of all laws for finite strain that separate it from that of shape. Simo and Hughes
   * (1998), Computational Inelasticity, section 9.2. */
  template <class Number>
  Number
  volume_energy(const double kappa, const Number &I)
  {
    using std::log;
    return 0.25 * kappa * (I - 1. - log(I));
  }
} // namespace Touchstone

#endif
