// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_collision_relative_motion_h
#define touchstone_collision_relative_motion_h

#include <touchstone/collision/first_crossing.h>

#include <deal.II/base/tensor.h>

#include <optional>

namespace Touchstone
{
  /**
   * @brief The differences between the points of the two partners of a crossing. These are 3 for
   * node and triangle, p - a, p - b, p - c, and 4 for two edges, a - c, a - d, b - c, b - d: the
   * partners have a point in common when the convex hull of the differences contains zero.
   *
   * Differences are rounded once, so their signs are exact and their errors are relative to
   * themselves: how far the points are from the origin does not matter. A power of two keeps
   * their products within the range of double; it has no other effect.
   */
  struct RelativeMotion
  {
    /** @brief 3 or 4. */
    unsigned int n;

    /** @brief At the start and at the end. */
    std::array<dealii::Tensor<1, dim>, 4> start, end;

    /** @brief Largest component in each direction, by amount. */
    dealii::Tensor<1, dim> size;

    /** @brief Of a node and a triangle. @throw NonConvergence if a coordinate is not finite. */
    static RelativeMotion
    node_triangle(const FourPoints &start, const FourPoints &end);

    /** @brief Of two edges. @throw NonConvergence if a coordinate is not finite. */
    static RelativeMotion
    edge_edge(const FourPoints &start, const FourPoints &end);

    /** @brief All differences lie on one side of zero, in the direction of an axis, all the time.
     */
    bool
    apart() const;

    /** @brief The differences at a time. The error is below 4 u size, u = 2^-53, if @p time has so
     * few digits that 1 - time is exact. */
    std::array<dealii::Tensor<1, dim>, 4>
    at(double time) const;
  };

  /**
   * @brief The first time at which the hull of the differences contains zero, by bisection of time
   * alone; also of degenerate motions, but slow.
   *
   * An interval of time is left out once a direction is found in which all differences, at its
   * start and at its end, are farther from zero than round-off: the differences are linear in time,
   * so those in between are in the hull of these 6 or 8 points. What remains at a width of 2^-48
   * is reported.
   */
  std::optional<double>
  first_inclusion(const RelativeMotion &motion);

  /** @brief Coefficients, not negative and of sum 1, of the point closest to zero of the convex
   * hull of the first @p n points. */
  std::array<double, 4>
  closest_to_zero(const std::array<dealii::Tensor<1, dim>, 4> &points, unsigned int n);
} // namespace Touchstone

#endif
