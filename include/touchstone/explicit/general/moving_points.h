// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_general_moving_points_h
#define touchstone_explicit_general_moving_points_h

#include <touchstone/base/types.h>

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace Touchstone
{
  /** @brief The box around points on straight paths. */
  class MotionBox
  {
  public:
    MotionBox() = default;

    /** @param from,to Where the points start and end. */
    template <std::size_t n>
    MotionBox(const std::array<dealii::Point<dim>, n> &from,
              const std::array<dealii::Point<dim>, n> &to)
    {
      for (unsigned int d = 0; d < dim; ++d)
        {
          const auto along = [d](const auto &a, const auto &b) { return a[d] < b[d]; };
          const auto first = std::minmax_element(from.begin(), from.end(), along),
                     last  = std::minmax_element(to.begin(), to.end(), along);
          lower[d]         = std::min((*first.first)[d], (*last.first)[d]);
          upper[d]         = std::max((*first.second)[d], (*last.second)[d]);
        }
    }

    /** @brief By how much they are apart along an axis, length; negative if they meet. */
    double
    distance(const MotionBox &other) const
    {
      double result = std::max(other.lower[0] - upper[0], lower[0] - other.upper[0]);
      for (unsigned int d = 1; d < dim; ++d)
        result = std::max({result, other.lower[d] - upper[d], lower[d] - other.upper[d]});
      return result;
    }

  private:
    std::array<double, dim> lower{}, upper{};
  };



  /** @brief A direction that changes at constant speed through a cycle; of any length. */
  struct TurningDirection
  {
    dealii::Tensor<1, dim> start, end;
  };



  /** @brief The tangents of a face along its diagonals and their cross product, at the start and at
   * the end of a cycle: what is said in them turns with the face. */
  class TurningFrame
  {
  public:
    TurningFrame() = default;

    /** @param from,to Corners of the face at the start and the end. */
    TurningFrame(const dealii::Point<dim> *from, const dealii::Point<dim> *to)
    {
      set(from, to);
    }

    void
    set(const dealii::Point<dim> *from, const dealii::Point<dim> *to)
    {
      set_tangents(from, start);
      set_tangents(to, end);
    }

    /** @brief The direction with these components. */
    TurningDirection
    turning(const dealii::Tensor<1, dim> &components) const
    {
      TurningDirection result;
      for (unsigned int i = 0; i < dim; ++i)
        {
          result.start += components[i] * start[i];
          result.end += components[i] * end[i];
        }
      return result;
    }

    /** @brief Components of a direction of the start; not finite if the face has no area. */
    dealii::Tensor<1, dim>
    components(const dealii::Tensor<1, dim> &direction) const
    {
      const auto &[p, q, n] = start;
      dealii::Tensor<1, dim> result;
      result[0] = direction * cross_product_3d(q, n);
      result[1] = direction * cross_product_3d(n, p);
      result[2] = direction * n;
      return result / n.norm_square();
    }

  private:
    std::array<dealii::Tensor<1, dim>, dim> start, end;

    static void
    set_tangents(const dealii::Point<dim> *const x, std::array<dealii::Tensor<1, dim>, dim> &of)
    {
      of[0] = x[2] - x[0];
      of[1] = x[3] - x[1];
      of[2] = cross_product_3d(of[0], of[1]);
    }
  };



  /**
   * @brief By how much the first @p m points are in front of all others along a direction at the
   * start of straight paths, if they are in front of them throughout; negative if they are not.
   *
   * The product of a difference, which is linear in time, with a direction that is so as well is
   * quadratic in time, and positive where its three coefficients for Bernstein's polynomials are.
   * As the direction turns with the points, groups that move together are told apart however much
   * they turn.
   *
   * @param margin They must be in front by more than this part of the largest difference, which has
   *               to be far above round-off.
   */
  template <std::size_t m, std::size_t n>
  double
  distance_in_front(const std::array<dealii::Point<dim>, n> &from,
                    const std::array<dealii::Point<dim>, n> &to,
                    const TurningDirection                  &direction,
                    const double                             margin)
  {
    std::array<double, 3> least, most;
    least.fill(std::numeric_limits<double>::max());
    most.fill(-std::numeric_limits<double>::max());
    double extent = 0.;
    for (std::size_t i = 0; i < n; ++i)
      {
        // Seen from a point of the others, so that it does not matter how far the origin is.
        const dealii::Tensor<1, dim> x = from[i] - from[m], y = to[i] - from[m];
        for (unsigned int d = 0; d < dim; ++d)
          extent = std::max({extent, std::abs(x[d]), std::abs(y[d])});
        const std::array<double, 3> along{{direction.start * x,
                                           0.5 * (direction.start * y + direction.end * x),
                                           direction.end * y}};
        for (unsigned int k = 0; k < 3; ++k)
          if (i < m)
            least[k] = std::min(least[k], along[k]);
          else
            most[k] = std::max(most[k], along[k]);
      }
    const double in_front = std::min({least[0] - most[0], least[1] - most[1], least[2] - most[2]});
    const double length   = std::max(direction.start.norm_square(), direction.end.norm_square());
    if (!(in_front > margin * extent * std::sqrt(length)))
      return -1.;
    return (least[0] - most[0]) / direction.start.norm();
  }



  /** @brief Nearly the shortest difference between the hulls of the first @p m points and of the
   * others, from these to those: to a tenth of its length, or anything small where hulls overlap
   * (Gilbert, Johnson and Keerthi 1988, IEEE J. Robot. Autom. 4, 193-203).
   * @param x The points, @p n in all. */
  dealii::Tensor<1, dim>
  shortest_difference(const dealii::Point<dim> *x, std::size_t m, std::size_t n);



  /** @brief The first @p m of some points on straight paths, and the others. */
  template <std::size_t m, std::size_t n>
  struct PointGroups
  {
    const std::array<dealii::Point<dim>, n> &from, &to;

    double
    distance_in_front(const TurningDirection &direction, const double margin) const
    {
      return Touchstone::distance_in_front<m>(from, to, direction, margin);
    }

    dealii::Tensor<1, dim>
    shortest_difference(const bool at_end) const
    {
      return Touchstone::shortest_difference((at_end ? to : from).data(), m, n);
    }
  };
} // namespace Touchstone

#endif
