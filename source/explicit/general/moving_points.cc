// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/relative_motion.h>
#include <touchstone/explicit/general/moving_points.h>

namespace Touchstone
{
  using namespace dealii;

  Tensor<1, dim>
  shortest_difference(const Point<dim> *const x, const std::size_t m, const std::size_t n)
  {
    constexpr unsigned int        most_steps  = 16;
    constexpr double              near_enough = 0.9;
    std::array<Tensor<1, dim>, 4> corners;
    corners[0]                = x[0] - x[m];
    unsigned int   n_corners  = 1;
    Tensor<1, dim> difference = corners[0];
    for (unsigned int step = 0; step < most_steps && n_corners < 4; ++step)
      {
        // The points of both that are nearest along the present one.
        std::size_t a = 0, b = m;
        double      first = difference * x[0], other = difference * x[m];
        for (std::size_t i = 1; i < m; ++i)
          if (const double along = difference * x[i]; along < first)
            {
              first = along;
              a     = i;
            }
        for (std::size_t i = m + 1; i < n; ++i)
          if (const double along = difference * x[i]; along > other)
            {
              other = along;
              b     = i;
            }
        const Tensor<1, dim> next   = x[a] - x[b];
        const double         square = difference.norm_square();
        if (difference * next >= near_enough * square ||
            std::find(corners.begin(), corners.begin() + n_corners, next) !=
              corners.begin() + n_corners)
          break;
        corners[n_corners++]                = next;
        const std::array<double, 4> weights = closest_to_zero(corners, n_corners);
        // Only those that it is between.
        unsigned int kept = 0;
        difference        = Tensor<1, dim>();
        for (unsigned int i = 0; i < n_corners; ++i)
          if (weights[i] > 0.)
            {
              difference += weights[i] * corners[i];
              corners[kept++] = corners[i];
            }
        n_corners = kept;
      }
    return difference;
  }
} // namespace Touchstone
