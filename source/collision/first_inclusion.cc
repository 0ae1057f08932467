// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/relative_motion.h>

#include <cmath>
#include <limits>

namespace Touchstone
{
  namespace
  {
    using dealii::Tensor;

    /** The differences at both ends of an interval of time. */
    struct Hull
    {
      unsigned int                  n;
      std::array<Tensor<1, dim>, 8> points;
    };

    /** Part of a that is orthogonal to b. */
    Tensor<1, dim>
    orthogonal(const Tensor<1, dim> &a, const Tensor<1, dim> &b)
    {
      const double square = b.norm_square();
      return square > 0. ? a - (a * b / square) * b : a;
    }

    /** Whether all points are farther from zero in a direction than their errors: 4 u size each,
     * and 3 u size for the product. */
    bool
    separates(const Tensor<1, dim> &direction, const Hull &hull, const Tensor<1, dim> &size)
    {
      double bound = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        bound += std::abs(direction[d]) * size[d];
      bound *= 5. * std::numeric_limits<double>::epsilon();
      for (unsigned int i = 0; i < hull.n; ++i)
        if (!(direction * hull.points[i] > bound))
          return false;
      return true;
    }

    /**
     * Whether a direction separates the points from zero. The point of the hull closest to zero is
     * within a corner, an edge or a triangle of points, and is the point of their line or plane
     * that is closest to zero: so one of these directions separates if any does by more than
     * round-off.
     */
    bool
    separated(const Hull &hull, const Tensor<1, dim> &size)
    {
      const auto &x = hull.points;
      for (unsigned int i = 0; i < hull.n; ++i)
        if (separates(x[i], hull, size))
          return true;
      for (unsigned int i = 0; i < hull.n; ++i)
        for (unsigned int j = 0; j < i; ++j)
          if (separates(orthogonal(x[i], x[j] - x[i]), hull, size))
            return true;
      for (unsigned int i = 0; i < hull.n; ++i)
        for (unsigned int j = 0; j < i; ++j)
          for (unsigned int k = 0; k < j; ++k)
            {
              const Tensor<1, dim> normal = cross_product_3d(x[j] - x[i], x[k] - x[i]);
              if (separates(normal * x[i] < 0. ? -normal : normal, hull, size))
                return true;
            }
      return false;
    }
  } // namespace



  std::optional<double>
  first_inclusion(const RelativeMotion &motion)
  {
    // An interval is [number, number + 1] 2^-level. The next one to the right on the way down is
    // the next number, and an even number has its parent: no stack is needed.
    constexpr unsigned int last   = 48;
    std::uint64_t          number = 0;
    unsigned int           level  = 0;
    while (true)
      {
        const double width = std::ldexp(1., -int(level));
        const auto   begin = motion.at(number * width), end = motion.at((number + 1) * width);
        Hull         hull{2 * motion.n, {}};
        for (unsigned int i = 0; i < motion.n; ++i)
          {
            hull.points[i]            = begin[i];
            hull.points[motion.n + i] = end[i];
          }
        if (!separated(hull, motion.size))
          {
            if (level == last)
              return number * width;
            number *= 2;
            ++level;
            continue;
          }
        ++number;
        for (; level > 0 && number % 2 == 0; --level)
          number /= 2;
        if (level == 0)
          return {};
      }
  }



  std::array<double, 4>
  closest_to_zero(const std::array<Tensor<1, dim>, 4> &points, const unsigned int n)
  {
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
