// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_collision_first_crossing_h
#define touchstone_collision_first_crossing_h

#include <touchstone/base/types.h>

#include <deal.II/base/point.h>

#include <array>
#include <optional>

namespace Touchstone
{
  /** @brief The first time at which a node and a triangle, or two edges, have a point in common. */
  struct Crossing
  {
    /** @brief Part of the motion, in [0, 1]. */
    double time;

    /** @brief Of a node and a triangle: barycentric coordinates of the common point, not negative
     * and of sum 1. Of two edges: its parameters s, t in [0, 1] on the first and the second edge,
     * a + s (b - a) and c + t (d - c), and 0. */
    std::array<double, 3> weights;
  };

  /** @brief Four points: a node and the corners of a triangle, or the ends of two edges. */
  using FourPoints = std::array<dealii::Point<dim>, 4>;

  /**
   * @brief The first time at which a node lies on a closed triangle, if there is one; all move on
   * straight lines and at constant speed from @p start to @p end (doc/first_crossing.md).
   *
   * What touches at the start crosses at time 0. Triangles without area, motion within a plane and
   * points at rest are cases like others. No crossing of the paths between the given coordinates,
   * taken as exact numbers, is missed; there may be a false alarm where the distance is within
   * round-off of the coordinates relative to each other, about 1e-15 of the largest. Coordinates
   * may have any unit: scaled by a power of two, they have the same result to the last bit.
   *
   * @param start, end Node, and corners a, b, c of the triangle.
   * @throw NonConvergence if a coordinate is not finite.
   */
  std::optional<Crossing>
  first_crossing_node_triangle(const FourPoints &start, const FourPoints &end);

  /**
   * @brief The first time at which two closed edges have a point in common, in all else like
   * first_crossing_node_triangle().
   *
   * @param start, end Ends a, b of the first edge and c, d of the second.
   * @throw NonConvergence if a coordinate is not finite.
   */
  std::optional<Crossing>
  first_crossing_edge_edge(const FourPoints &start, const FourPoints &end);
} // namespace Touchstone

#endif
