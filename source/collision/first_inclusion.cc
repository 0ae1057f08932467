// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/bernstein.h>
#include <touchstone/collision/relative_motion.h>
#include <touchstone/collision/round_off.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace Touchstone
{
  namespace
  {
    using dealii::Tensor;
    using Path   = Bernstein<1, Tensor<1, dim>>;
    using Points = std::array<Tensor<1, dim>, 4>;

    /** Errors relative to the size: 4 u of a point, and 3 u of its product with a direction. */
    constexpr double round_off = 10. * unit_round_off;

    /** Points that are as close to zero touch. It is more than round-off, since what is farther
     * away must be separated for a while, and the while grows with the square root of the distance
     * where points turn around each other; and it is even more after so many intervals. */
    constexpr double       touching_at_first = 0x1p-46, touching_at_last = 0x1p-40;
    constexpr unsigned int patience = 1000;

    /** The differences in an interval of time: points at its start and at its end, their paths,
     * and a bound of their components. */
    struct Interval
    {
      unsigned int                  n;
      std::array<Tensor<1, dim>, 8> points;
      Tensor<1, dim>                size;

      Path
      path(const unsigned int i) const
      {
        return {{{points[i], points[n + i]}}};
      }
    };



    /** Whether the first @p n points are farther from zero in a direction than a part of the size.
     */
    bool
    separates(const Tensor<1, dim> &direction,
              const Interval       &interval,
              const unsigned int    n,
              const double          margin)
    {
      double bound = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        bound += std::abs(direction[d]) * interval.size[d];
      bound = margin * bound + underflow;
      for (unsigned int i = 0; i < n; ++i)
        if (!(direction * interval.points[i] > bound))
          return false;
      return true;
    }



    /** Part of a that is orthogonal to b: twice, since what cancels the first time leaves errors
     * that are large for what is left. */
    Tensor<1, dim>
    orthogonal(Tensor<1, dim> a, const Tensor<1, dim> &b)
    {
      const double square = b.norm_square();
      if (square > 0.)
        for (unsigned int i = 0; i < 2; ++i)
          a -= (a * b / square) * b;
      return a;
    }



    /**
     * Whether one direction separates the first @p n points from zero. The point of their hull
     * closest to zero is within a corner, an edge or a triangle of points, and is the point of
     * their line or plane that is closest to zero: one of these directions separates if any does by
     * more than round-off.
     */
    bool
    separated(const Interval &interval, const unsigned int n, const double margin)
    {
      const auto &x = interval.points;
      for (unsigned int i = 0; i < n; ++i)
        if (separates(x[i], interval, n, margin))
          return true;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < i; ++j)
          if (separates(orthogonal(x[i], x[j] - x[i]), interval, n, margin))
            return true;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < i; ++j)
          for (unsigned int k = 0; k < j; ++k)
            {
              const Tensor<1, dim> normal = cross_product_3d(x[j] - x[i], x[k] - x[i]);
              if (separates(normal * x[i] < 0. ? -normal : normal, interval, n, margin))
                return true;
            }
      return false;
    }



    /** Largest component of coefficients, by amount. */
    template <unsigned int degree>
    double
    largest(const Bernstein<degree, Tensor<1, dim>> &path)
    {
      double result = 0.;
      for (const Tensor<1, dim> &x : path.coefficients)
        for (unsigned int d = 0; d < dim; ++d)
          result = std::max(result, std::abs(x[d]));
      return result;
    }



    /** Whether a path stays away from zero, by more than errors of its components, on one side of
     * the plane that is orthogonal to one of its coefficients. */
    template <unsigned int degree>
    bool
    stays_away(const Bernstein<degree, Tensor<1, dim>> &path, const double error)
    {
      const Tensor<1, dim> &direction = path.coefficients[degree / 2];
      const double sum = std::abs(direction[0]) + std::abs(direction[1]) + std::abs(direction[2]);
      for (const Tensor<1, dim> &x : path.coefficients)
        if (!(direction * x > 2. * error * sum + underflow))
          return false;
      return true;
    }



    /** Whether a difference separates, as a direction that turns: its products with others. */
    bool
    corner_separates(const unsigned int corner, const Interval &interval, const double size)
    {
      const Path   x     = interval.path(corner);
      const double error = 8. * unit_round_off * size;
      if (!stays_away(x, error))
        return false;
      for (unsigned int i = 0; i < interval.n; ++i)
        if (i != corner)
          {
            const Path y = interval.path(i);
            if (!(dot(x, y).lowest() > 3. * error * (largest(x) + largest(y) + error)))
              return false;
          }
      return true;
    }



    /**
     * The same for the part of a difference x that is orthogonal to the line e to another one,
     * e × (x × e). Its product with a difference y is (x × e) (y × e): small in proportion to the
     * distance of x from the line only, though of the fourth degree, since that with x itself is
     * not needed: it is a square.
     */
    bool
    edge_separates(const unsigned int i,
                   const unsigned int j,
                   const Interval    &interval,
                   const double       size)
    {
      const Path   x = interval.path(i), edge = interval.path(j) - x;
      const double length = largest(edge);
      // 4 u size of a difference, twice that of the edge, two products each; 6 u of their sum.
      const auto error_of = [&](const Path &y) {
        return unit_round_off * size * (24. * largest(y) + 16. * length);
      };
      const auto   first = cross(x, edge);
      const double error = error_of(x), amount = largest(first);
      if (!stays_away(first, error))
        return false;
      for (unsigned int k = 0; k < interval.n; ++k)
        if (k != i && k != j)
          {
            const Path   y            = interval.path(k);
            const auto   second       = cross(y, edge);
            const double second_error = error_of(y), second_amount = largest(second);
            const double bound =
              3. * (amount * second_error + second_amount * error + error * second_error +
                    10. * unit_round_off * amount * second_amount) +
              underflow;
            if (!(dot(first, second).lowest() > bound))
              return false;
          }
      return true;
    }



    /** Whether one of the directions that turn with the points separates them from zero. */
    bool
    turning_separated(const Interval &interval)
    {
      const double size   = std::max({interval.size[0], interval.size[1], interval.size[2]});
      const auto   volume = dot(interval.path(0), cross(interval.path(1), interval.path(2)));
      const double bound  = 200. * unit_round_off * size * size * size;
      if (volume.lowest() > bound || volume.highest() < -bound)
        return true;
      for (unsigned int i = 0; i < interval.n; ++i)
        if (corner_separates(i, interval, size))
          return true;
      // Edges of the triangle; of the parallelogram, not its diagonals.
      for (unsigned int i = 0; i < interval.n; ++i)
        for (unsigned int j = 0; j < i; ++j)
          if ((interval.n == 3 || i + j != 3) && edge_separates(i, j, interval, size))
            return true;
      return false;
    }
  } // namespace



  std::optional<double>
  first_inclusion(const RelativeMotion &motion)
  {
    // An interval of time is [number, number + 1] 2^-level. To the right of one that was left out
    // comes the next number, and an even number starts where its parent does: no stack is needed.
    constexpr unsigned int last   = 48;
    std::uint64_t          number = 0;
    unsigned int           level  = 0;
    for (unsigned int count = 0;; ++count)
      {
        const double width = std::ldexp(1., -int(level));
        const Points begin = motion.at(number * width), end = motion.at((number + 1) * width);
        Interval     interval{motion.n, {}, motion.size};
        for (unsigned int i = 0; i < motion.n; ++i)
          {
            interval.points[i]            = begin[i];
            interval.points[motion.n + i] = end[i];
          }
        const double touching = count < patience ? touching_at_first : touching_at_last;
        if (!separated(interval, motion.n, touching))
          return number * width;
        if (!turning_separated(interval) && !separated(interval, 2 * motion.n, round_off))
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
} // namespace Touchstone
