// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/bernstein.h>
#include <touchstone/collision/first_root.h>
#include <touchstone/collision/round_off.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Touchstone
{
  namespace
  {
    using dealii::Tensor;
    using Cubic = std::array<double, 4>;

    double
    largest(const Tensor<1, dim> &x)
    {
      return std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
    }



    /** The largest component of what a difference changes by in the whole motion, not less. */
    double
    way(const RelativeMotion &motion)
    {
      double result = 0.;
      for (unsigned int i = 0; i < motion.n; ++i)
        result = std::max(result, largest(motion.end[i] - motion.start[i]));
      return (1. + 4. * unit_round_off) * result;
    }



    /** The volume by Bernstein's polynomials on the whole motion, and a bound of its errors. */
    Cubic
    volume(const RelativeMotion &motion, double &error)
    {
      const auto &[a0, b0, c0, d0] = motion.start;
      const auto &[a1, b1, c1, d1] = motion.end;
      const Tensor<1, dim> first = cross_product_3d(b0, c0), last = cross_product_3d(b1, c1),
                           twice = cross_product_3d(b0, c1) + cross_product_3d(b1, c0);
      // Of 6 products of three differences each: 3 u from the differences, 2 u from the products
      // and 6 u from sums, 18 u from splitting the interval 6 times, 8 u from value().
      error = underflow + 6. * 40. * unit_round_off * std::max(largest(a0), largest(a1)) *
                            std::max(largest(b0), largest(b1)) * std::max(largest(c0), largest(c1));
      return {
        {a0 * first, (a1 * first + a0 * twice) / 3., (a0 * last + a1 * twice) / 3., a1 * last}};
    }



    /** 1 or -1 if the polynomial has this sign on the whole interval. */
    int
    sign(const Cubic &b, const double error)
    {
      if (std::min({b[0], b[1], b[2], b[3]}) > error)
        return 1;
      return std::max({b[0], b[1], b[2], b[3]}) < -error ? -1 : 0;
    }



    /** It rises or falls on the whole interval. */
    bool
    monotone(const Cubic &b, const double error)
    {
      const double least = 2. * error, x = b[1] - b[0], y = b[2] - b[1], z = b[3] - b[2];
      return (x > least && y > least && z > least) || (x < -least && y < -least && z < -least);
    }



    double
    value(const Cubic &b, const double x)
    {
      const double y = 1. - x;
      return y * y * (y * b[0] + 3. * x * b[1]) + x * x * (3. * y * b[2] + x * b[3]);
    }



    double
    slope(const Cubic &b, const double x)
    {
      const double y = 1. - x;
      return 3. * (y * y * (b[1] - b[0]) + 2. * x * y * (b[2] - b[1]) + x * x * (b[3] - b[2]));
    }



    /** The root of a polynomial that is monotone and changes its sign, by Newton's method within
     * the interval that is left. */
    double
    root(const Cubic &b, const double error)
    {
      double lower = 0., upper = 1., x = b[0] / (b[0] - b[3]);
      for (unsigned int i = 0; i < 60; ++i)
        {
          const double f = value(b, x);
          if (std::abs(f) <= 0.25 * error)
            break;
          ((f > 0.) == (b[3] > 0.) ? upper : lower) = x;
          x -= f / slope(b, x);
          if (!(x > lower && x < upper))
            x = 0.5 * (lower + upper);
        }
      return x;
    }



    /** De Casteljau's scheme at the middle. */
    void
    split(const Cubic &b, Cubic &left, Cubic &right)
    {
      const double x = 0.5 * (b[0] + b[1]), y = 0.5 * (b[1] + b[2]), z = 0.5 * (b[2] + b[3]),
                   xy = 0.5 * (x + y), yz = 0.5 * (y + z), middle = 0.5 * (xy + yz);
      left  = {{b[0], x, xy, middle}};
      right = {{middle, yz, z, b[3]}};
    }



    /** Whether the hull of differences that lie in a plane with zero contains it, and where. Each
     * component of the differences may have the error @p eta. */
    Verdict
    inside(const std::array<Tensor<1, dim>, 4> &x,
           const unsigned int                   n,
           const double                         eta,
           Crossing                            &crossing)
    {
      std::array<double, 4> g;
      double                sum;
      if (n == 3)
        {
          const Tensor<1, dim> normal = cross_product_3d(x[1] - x[0], x[2] - x[0]);
          g[0]                        = normal * cross_product_3d(x[1], x[2]);
          g[1]                        = normal * cross_product_3d(x[2], x[0]);
          g[2]                        = normal * cross_product_3d(x[0], x[1]);
          g[3] = sum = g[0] + g[1] + g[2];
        }
      else
        {
          const Tensor<1, dim> first = x[2] - x[0], second = x[0] - x[1],
                               normal = cross_product_3d(first, second);
          sum                         = normal.norm_square();
          g[0]                        = -(cross_product_3d(x[0], second) * normal);
          g[1]                        = -(cross_product_3d(x[0], first) * normal);
          g[2]                        = sum - g[0];
          g[3]                        = sum - g[1];
        }
      // Normals have components up to 8 r^2 with an error of 16 r eta, the other products up to
      // 4 r^2 with 12 r eta: 3 (8 12 + 4 16) r^3 eta = 480 r^3 eta, 3 (8 16 + 8 16) = 768 for
      // the square of the normal, both for a difference; and their round-off, as eta >= 4 u r.
      double r = eta;
      for (unsigned int i = 0; i < n; ++i)
        r = std::max(r, largest(x[i]) + eta);
      const double bound = 2000. * r * r * r * eta, least = *std::min_element(g.begin(), g.end());
      if (least < -bound)
        return Verdict::apart;
      if (!(least > bound))
        return Verdict::unsure;
      crossing.weights = {{g[0] / sum, g[1] / sum, n == 3 ? g[2] / sum : 0.}};
      return Verdict::crossing;
    }



    /** Whether there is a crossing at the only root of the volume in an interval. */
    Verdict
    at_root(const RelativeMotion &motion,
            const Cubic          &b,
            const double          begin,
            const double          width,
            const double          error,
            Crossing             &crossing)
    {
      // Where the volume is certainly not zero on either side.
      const double x = root(b, error), steep = std::abs(slope(b, x));
      const double delta = 4. * error / steep;
      const double lower = std::max(0., x - delta), upper = std::min(1., x + delta);
      const double rise = b[3] > 0. ? 1. : -1.;
      if (!(rise * value(b, lower) < -error && rise * value(b, upper) > error))
        return Verdict::unsure;
      crossing.time = begin + x * width;
      // Within the window of time the points go on by no more than the window's part of their way.
      const double eta =
        16. * unit_round_off * largest(motion.size) + 2. * delta * width * way(motion);
      return inside(motion.at(crossing.time), motion.n, eta, crossing);
    }
  } // namespace



  Verdict
  first_root(const RelativeMotion &motion, Crossing &crossing)
  {
    double      error;
    const Cubic all = volume(motion, error);
    if (sign(all, error) != 0)
      return Verdict::apart;
    // Intervals in ascending order, the first of them at the back.
    struct Interval
    {
      Cubic        b;
      double       begin, width;
      unsigned int level;
    };
    constexpr unsigned int         last = 6;
    std::array<Interval, last + 2> stack;
    unsigned int                   n = 0;
    stack[n++]                       = {all, 0., 1., 0};
    while (n > 0)
      {
        const Interval now = stack[--n];
        if (sign(now.b, error) != 0)
          continue;
        // Ends that may be roots themselves are neither in this interval nor in the next for sure.
        if (std::abs(now.b[0]) <= error || std::abs(now.b[3]) <= error)
          return Verdict::unsure;
        if (now.b[0] * now.b[3] < 0. && monotone(now.b, error))
          {
            const Verdict verdict = at_root(motion, now.b, now.begin, now.width, error, crossing);
            if (verdict != Verdict::apart)
              return verdict;
            continue;
          }
        if (now.level == last)
          return Verdict::unsure;
        const double half = 0.5 * now.width;
        stack[n]          = {{}, now.begin + half, half, now.level + 1};
        stack[n + 1]      = {{}, now.begin, half, now.level + 1};
        split(now.b, stack[n + 1].b, stack[n].b);
        n += 2;
      }
    return Verdict::apart;
  }
} // namespace Touchstone
