// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_collision_round_off_h
#define touchstone_collision_round_off_h

#include <limits>

namespace Touchstone
{
  /** @brief Largest relative error of one operation, 2^-53; comments call it u. */
  constexpr double unit_round_off = std::numeric_limits<double>::epsilon() / 2.;

  /** @brief Errors of products that are so small that digits are cut off, which their relative
   * errors do not cover; far below all bounds of differences of about 1, or 2^-200 at least. */
  constexpr double underflow = 0x1p-1000;
} // namespace Touchstone

#endif
