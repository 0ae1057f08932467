// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_overlap_order_h
#define touchstone_contact_overlap_order_h

#include <touchstone/base/types.h>

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace Touchstone
{
  /** @brief A key that sorts overlaps by their depth, the deepest first, and equally deep ones by
   * their place, in numbers that are rounded: whatever round-off makes of them, the first is the
   * same one, on any number of ranks. @param depth, deepest Of this one, and the largest; length.
   */
  inline std::array<double, 1 + dim>
  overlap_order(const double depth, const dealii::Point<dim> &x, const double deepest)
  {
    // Scenes have round coordinates: the shift keeps them off the limits between two numbers.
    constexpr double shift = 0.3183;
    const double     unit  = 1e-4 * deepest;
    const auto rounded = [unit](const double value) { return std::floor(value / unit + shift); };
    return {{-rounded(depth), rounded(x[0]), rounded(x[1]), rounded(x[2])}};
  }

  /** @brief Sort overlaps by their overlap_order().
   * @param place_of The `depth` and `x` of one of them. */
  template <class Overlap, class PlaceOf>
  void
  sort_by_depth(std::vector<Overlap> &overlaps, const PlaceOf &place_of)
  {
    double deepest = 0.;
    for (const Overlap &overlap : overlaps)
      deepest = std::max(deepest, place_of(overlap).depth);
    const auto order = [&](const Overlap &overlap) {
      return overlap_order(place_of(overlap).depth, place_of(overlap).x, deepest);
    };
    std::sort(overlaps.begin(), overlaps.end(), [&](const Overlap &a, const Overlap &b) {
      return order(a) < order(b);
    });
  }
} // namespace Touchstone

#endif
