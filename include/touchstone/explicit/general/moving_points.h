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

    bool
    meets(const MotionBox &other) const
    {
      bool apart = false;
      for (unsigned int d = 0; d < dim; ++d)
        apart |= upper[d] < other.lower[d] || other.upper[d] < lower[d];
      return !apart;
    }

  private:
    std::array<double, dim> lower{}, upper{};
  };



  /** @brief Whether the first @p n_first points are on one side of all others along a direction, by
   * more than round-off, at the start and at the end of straight paths, and so throughout. */
  template <std::size_t n>
  bool
  stay_apart(const std::array<dealii::Point<dim>, n> &from,
             const std::array<dealii::Point<dim>, n> &to,
             const std::size_t                        n_first,
             const dealii::Tensor<1, dim>            &direction)
  {
    constexpr double round_off = 1e-13;
    double           below = std::numeric_limits<double>::max(), above = below, size = 0.;
    for (const auto *const x : {&from, &to})
      {
        // Least and largest of both groups.
        std::array<double, 2> low, high;
        low.fill(std::numeric_limits<double>::max());
        high.fill(-std::numeric_limits<double>::max());
        for (std::size_t i = 0; i < n; ++i)
          {
            const double along = (*x)[i] * direction;
            low[i >= n_first]  = std::min(low[i >= n_first], along);
            high[i >= n_first] = std::max(high[i >= n_first], along);
            for (unsigned int d = 0; d < dim; ++d)
              size = std::max(size, std::abs((*x)[i][d]));
          }
        below = std::min(below, low[1] - high[0]);
        above = std::min(above, low[0] - high[1]);
      }
    return std::max(below, above) > round_off * size * direction.norm();
  }
} // namespace Touchstone

#endif
