// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/relative_motion.h>

#include <limits>

namespace Touchstone
{
  std::array<double, 4>
  closest_to_zero(const std::array<dealii::Tensor<1, dim>, 4> &points, const unsigned int n)
  {
    using dealii::Tensor;
    std::array<double, 4> best{};
    double                smallest = std::numeric_limits<double>::infinity();
    const auto            consider = [&](const std::array<double, 4> &weights) {
      Tensor<1, dim> x;
      for (unsigned int i = 0; i < n; ++i)
        {
          if (!(weights[i] >= 0.))
            return;
          x += weights[i] * points[i];
        }
      if (x.norm_square() < smallest)
        {
          smallest = x.norm_square();
          best     = weights;
        }
    };
    for (unsigned int i = 0; i < n; ++i)
      {
        std::array<double, 4> weights{};
        weights[i] = 1.;
        consider(weights);
        for (unsigned int j = 0; j < i; ++j)
          {
            const Tensor<1, dim> edge = points[j] - points[i];
            weights                   = {};
            weights[j]                = -(points[i] * edge) / edge.norm_square();
            weights[i]                = 1. - weights[j];
            consider(weights);
            for (unsigned int k = 0; k < j; ++k)
              {
                const Tensor<1, dim> other  = points[k] - points[i],
                                     normal = cross_product_3d(edge, other);
                const double square         = normal.norm_square();
                weights                     = {};
                weights[j] = -(cross_product_3d(points[i], other) * normal) / square;
                weights[k] = -(cross_product_3d(edge, points[i]) * normal) / square;
                weights[i] = 1. - weights[j] - weights[k];
                consider(weights);
              }
          }
      }
    return best;
  }
} // namespace Touchstone
