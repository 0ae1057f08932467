// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_n_lanes_h
#define touchstone_explicit_n_lanes_h

namespace Touchstone
{
  /** @brief Cells of a block: those that are computed at once, by vectors of as many numbers. */
  constexpr unsigned int n_lanes = 8;
} // namespace Touchstone

#endif
