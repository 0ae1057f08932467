// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_smooth_step_h
#define touchstone_contact_pairing_smooth_step_h

namespace Touchstone
{
  /** @brief The cubic step S(x; begin, end) of doc/theory.md 3: zero up to @p begin, one from
   * @p end on, with a continuous first derivative.
   * @tparam Number double, or a number that carries derivatives (Sacado). */
  template <typename Number>
  Number
  smooth_step(const Number &x, const double begin, const double end)
  {
    if (x <= begin)
      return Number(0.);
    if (x >= end)
      return Number(1.);
    const Number t = (x - begin) / (end - begin);
    return t * t * (3. - 2. * t);
  }
} // namespace Touchstone

#endif
