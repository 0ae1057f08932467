// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_collision_round_off_h
#define touchstone_collision_round_off_h

#include <limits>

namespace Touchstone
{
  /** @brief Largest relative error of one operation, 2^-53; comments call it u. */
  constexpr double unit_round_off = std::numeric_limits<double>::epsilon() / 2.;
} // namespace Touchstone

#endif
