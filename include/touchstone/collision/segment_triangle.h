// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_collision_segment_triangle_h
#define touchstone_collision_segment_triangle_h

#include <touchstone/base/types.h>

#include <deal.II/base/point.h>

#include <array>

namespace Touchstone
{
  /**
   * @brief Whether a closed segment and a closed triangle have a point in common, exactly for the
   * given coordinates: to find surfaces that cross at the start of a run.
   *
   * Segments in the plane of the triangle, segments that are points, and triangles without area
   * are cases like others. Signs of volumes and areas are exact: where a bound of the round-off
   * (Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust geometric
   * predicates") does not decide, they are found in whole numbers of any length.
   *
   * @throw NonConvergence if a coordinate is not finite.
   */
  bool
  intersects(const std::array<dealii::Point<dim>, 2> &segment,
             const std::array<dealii::Point<dim>, 3> &triangle);
} // namespace Touchstone

#endif
