// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/non_convergence.h>
#include <touchstone/collision/relative_motion.h>

#include <algorithm>
#include <cmath>

namespace Touchstone
{
  namespace
  {
    using Pairs                    = std::array<std::pair<unsigned int, unsigned int>, 4>;
    constexpr Pairs pairs_of_node  = {{{0, 1}, {0, 2}, {0, 3}, {0, 3}}};
    constexpr Pairs pairs_of_edges = {{{0, 2}, {0, 3}, {1, 2}, {1, 3}}};

    void
    check_finite(const FourPoints &start, const FourPoints &end)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          sum += 0. * start[i][d] + 0. * end[i][d];
      if (!(sum == 0.))
        throw NonConvergence("A coordinate is not finite where crossings are sought.");
    }



    /** Differences, multiplied by a power of two before they are taken and one afterwards. */
    void
    subtract(RelativeMotion   &motion,
             const Pairs      &pairs,
             const FourPoints &start,
             const FourPoints &end)
    {
      for (unsigned int d = 0; d < dim; ++d)
        motion.size[d] = 0.;
      for (unsigned int i = 0; i < motion.n; ++i)
        {
          const auto [p, q] = pairs[i];
          for (unsigned int d = 0; d < dim; ++d)
            {
              motion.start[i][d] = start[p][d] - start[q][d];
              motion.end[i][d]   = end[p][d] - end[q][d];
              motion.size[d]     = std::max(
                {motion.size[d], std::abs(motion.start[i][d]), std::abs(motion.end[i][d])});
            }
        }
    }



    double
    largest(const RelativeMotion &motion)
    {
      return std::max({motion.size[0], motion.size[1], motion.size[2]});
    }



    /** Coordinates that are so large or so close that powers of differences leave the range. */
    void
    subtract_scaled(RelativeMotion &motion, const Pairs &pairs, FourPoints start, FourPoints end)
    {
      // What a smaller scale cuts off is far below round-off of the largest difference.
      if (!std::isfinite(largest(motion)))
        {
          for (unsigned int i = 0; i < 4; ++i)
            for (unsigned int d = 0; d < dim; ++d)
              {
                start[i][d] = std::ldexp(start[i][d], -4);
                end[i][d]   = std::ldexp(end[i][d], -4);
              }
          subtract(motion, pairs, start, end);
        }
      const double most = largest(motion);
      if (most == 0.)
        return;
      const int exponent = -std::ilogb(most);
      for (unsigned int d = 0; d < dim; ++d)
        {
          motion.size[d] = std::ldexp(motion.size[d], exponent);
          for (unsigned int i = 0; i < motion.n; ++i)
            {
              motion.start[i][d] = std::ldexp(motion.start[i][d], exponent);
              motion.end[i][d]   = std::ldexp(motion.end[i][d], exponent);
            }
        }
    }



    RelativeMotion
    make(const unsigned int n, const Pairs &pairs, const FourPoints &start, const FourPoints &end)
    {
      check_finite(start, end);
      RelativeMotion motion;
      motion.n = n;
      subtract(motion, pairs, start, end);
      const double most = largest(motion);
      if (!(most > 0x1p-200 && most < 0x1p200))
        subtract_scaled(motion, pairs, start, end);
      return motion;
    }
  } // namespace



  RelativeMotion
  RelativeMotion::node_triangle(const FourPoints &start, const FourPoints &end)
  {
    return make(3, pairs_of_node, start, end);
  }



  RelativeMotion
  RelativeMotion::edge_edge(const FourPoints &start, const FourPoints &end)
  {
    return make(4, pairs_of_edges, start, end);
  }



  bool
  RelativeMotion::apart() const
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        bool above = true, below = true;
        for (unsigned int i = 0; i < n; ++i)
          {
            above = above && start[i][d] > 0. && end[i][d] > 0.;
            below = below && start[i][d] < 0. && end[i][d] < 0.;
          }
        if (above || below)
          return true;
      }
    return false;
  }



  std::array<dealii::Tensor<1, dim>, 4>
  RelativeMotion::at(const double time) const
  {
    std::array<dealii::Tensor<1, dim>, 4> points;
    for (unsigned int i = 0; i < n; ++i)
      points[i] = (1. - time) * start[i] + time * end[i];
    return points;
  }
} // namespace Touchstone
