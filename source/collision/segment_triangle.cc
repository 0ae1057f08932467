// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/non_convergence.h>
#include <touchstone/collision/round_off.h>
#include <touchstone/collision/segment_triangle.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

namespace Touchstone
{
  namespace
  {
    using Corner  = dealii::Point<dim>;
    using Integer = boost::multiprecision::cpp_int;

    int
    sign(const double x)
    {
      return (x > 0.) - (x < 0.);
    }



    /** Determinant of three vectors, and the sum of its products by amount. */
    template <class Number>
    Number
    volume(const std::array<std::array<Number, dim>, 3> &x, Number *amount)
    {
      Number result(0);
      for (unsigned int k = 0; k < dim; ++k)
        {
          const unsigned int l = (k + 1) % dim, m = (k + 2) % dim;
          const Number       first = x[1][l] * x[2][m], second = x[1][m] * x[2][l];
          result += x[0][k] * (first - second);
          if (amount)
            *amount += abs(x[0][k]) * (abs(first) + abs(second));
        }
      return result;
    }



    /** The points times a power of two that makes whole numbers of all coordinates. */
    template <std::size_t n>
    std::array<std::array<Integer, dim>, n>
    whole(const std::array<Corner, n> &points)
    {
      int lowest = std::numeric_limits<int>::max();
      for (const Corner &x : points)
        for (unsigned int k = 0; k < dim; ++k)
          if (x[k] != 0.)
            lowest = std::min(lowest, std::ilogb(x[k]));
      std::array<std::array<Integer, dim>, n> result;
      for (std::size_t i = 0; i < n; ++i)
        for (unsigned int k = 0; k < dim; ++k)
          if (points[i][k] != 0.)
            {
              const int exponent = std::ilogb(points[i][k]);
              result[i][k]       = std::int64_t(std::ldexp(points[i][k], 52 - exponent));
              result[i][k] <<= exponent - lowest;
            }
      return result;
    }



    /** On which side of the plane of three points a fourth is: 1, -1 or 0. */
    int
    side(const Corner &a, const Corner &b, const Corner &c, const Corner &d)
    {
      std::array<std::array<double, dim>, 3> x;
      for (unsigned int k = 0; k < dim; ++k)
        {
          x[0][k] = a[k] - d[k];
          x[1][k] = b[k] - d[k];
          x[2][k] = c[k] - d[k];
        }
      double       amount = 0.;
      const double result = volume(x, &amount);
      // Below the second number products may underflow; what overflows fails the comparison, too.
      if (std::abs(result) > 16. * unit_round_off * amount && amount > 0x1p-900)
        return sign(result);
      const auto [p, q, r, s] = whole<4>({{a, b, c, d}});
      std::array<std::array<Integer, dim>, 3> exact;
      for (unsigned int k = 0; k < dim; ++k)
        {
          exact[0][k] = p[k] - s[k];
          exact[1][k] = q[k] - s[k];
          exact[2][k] = r[k] - s[k];
        }
      return volume<Integer>(exact, nullptr).sign();
    }



    /** On which side of the line of two points a third is, without the coordinate @p k. */
    int
    side(const Corner &a, const Corner &b, const Corner &c, const unsigned int k)
    {
      const unsigned int l = (k + 1) % dim, m = (k + 2) % dim;
      const double first = (a[l] - c[l]) * (b[m] - c[m]), second = (a[m] - c[m]) * (b[l] - c[l]),
                   result = first - second, amount = std::abs(first) + std::abs(second);
      if (std::abs(result) > 8. * unit_round_off * amount && amount > 0x1p-900)
        return sign(result);
      const auto [p, q, r] = whole<3>({{a, b, c}});
      const Integer exact =
        Integer(p[l] - r[l]) * Integer(q[m] - r[m]) - Integer(p[m] - r[m]) * Integer(q[l] - r[l]);
      return exact.sign();
    }



    /** Segments in one plane. They have a point in common if they have one without any of the
     * coordinates: without one of them, no two points of the plane become the same. */
    bool
    segments_meet(const Corner &a, const Corner &b, const Corner &c, const Corner &d)
    {
      for (unsigned int k = 0; k < dim; ++k)
        if (std::max(a[k], b[k]) < std::min(c[k], d[k]) ||
            std::max(c[k], d[k]) < std::min(a[k], b[k]) ||
            side(a, b, c, k) * side(a, b, d, k) > 0 || side(c, d, a, k) * side(c, d, b, k) > 0)
          return false;
      return side(a, b, c, d) == 0;
    }



    /** Whether a point of the plane of a triangle is in it. Not in one without area: a point of
     * it is on an edge. */
    bool
    contains(const std::array<Corner, 3> &triangle, const Corner &p)
    {
      const auto &[a, b, c] = triangle;
      bool has_area         = false;
      for (unsigned int k = 0; k < dim; ++k)
        {
          const int x = side(a, b, p, k), y = side(b, c, p, k), z = side(c, a, p, k);
          if (std::min({x, y, z}) < 0 && std::max({x, y, z}) > 0)
            return false;
          has_area = has_area || side(a, b, c, k) != 0;
        }
      return has_area;
    }
  } // namespace



  bool
  intersects(const std::array<Corner, 2> &segment, const std::array<Corner, 3> &triangle)
  {
    const auto &[p, q]    = segment;
    const auto &[a, b, c] = triangle;
    for (const Corner &x : {p, q, a, b, c})
      for (unsigned int k = 0; k < dim; ++k)
        if (!std::isfinite(x[k]))
          throw NonConvergence("A coordinate is not finite where crossings are sought.");
    for (unsigned int k = 0; k < dim; ++k)
      if (std::max(p[k], q[k]) < std::min({a[k], b[k], c[k]}) ||
          std::min(p[k], q[k]) > std::max({a[k], b[k], c[k]}))
        return false;
    const int first = side(a, b, c, p), second = side(a, b, c, q);
    if (first * second > 0)
      return false;
    if (first == 0 && second == 0)
      return segments_meet(p, q, a, b) || segments_meet(p, q, b, c) || segments_meet(p, q, c, a) ||
             contains(triangle, p);
    // The segment reaches the plane on both sides: its line passes all edges on the same side.
    const int x = side(p, q, a, b), y = side(p, q, b, c), z = side(p, q, c, a);
    return !(std::min({x, y, z}) < 0 && std::max({x, y, z}) > 0);
  }
} // namespace Touchstone
