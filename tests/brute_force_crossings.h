// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_tests_brute_force_crossings_h
#define touchstone_tests_brute_force_crossings_h

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <optional>
#include <vector>

/**
 * Crossings of moving points in exact arithmetic, for tests: slow, and without a line in common
 * with the code of the program.
 *
 * Two partners have a point in common if the hull of the differences of their points contains
 * zero. If it does not, one of few directions separates, each a polynomial of time, and so are its
 * products with the differences. Coordinates are integers after multiplication by a power of two,
 * and so are the coefficients of these polynomials on any interval of a bisection, as polynomials
 * of Bernstein: they are all of one sign where the interval is short enough, or there is a root.
 */
namespace BruteForce
{
  using Integer    = boost::multiprecision::cpp_int;
  using Polynomial = std::vector<Integer>;
  using Path       = std::array<Polynomial, 3>;
  using Points     = std::array<dealii::Point<3>, 4>;

  inline Polynomial
  sum(const Polynomial &a, const Polynomial &b, const int sign = 1)
  {
    Polynomial result(std::max(a.size(), b.size()));
    for (std::size_t i = 0; i < a.size(); ++i)
      result[i] += a[i];
    for (std::size_t i = 0; i < b.size(); ++i)
      result[i] += sign * b[i];
    return result;
  }

  inline Polynomial
  product(const Polynomial &a, const Polynomial &b)
  {
    Polynomial result(a.size() + b.size() - 1);
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < b.size(); ++j)
        result[i + j] += a[i] * b[j];
    return result;
  }

  inline Polynomial
  dot(const Path &a, const Path &b)
  {
    return sum(sum(product(a[0], b[0]), product(a[1], b[1])), product(a[2], b[2]));
  }

  inline Path
  difference(const Path &a, const Path &b)
  {
    return {{sum(a[0], b[0], -1), sum(a[1], b[1], -1), sum(a[2], b[2], -1)}};
  }

  inline Path
  cross(const Path &a, const Path &b)
  {
    Path result;
    for (unsigned int d = 0; d < 3; ++d)
      result[d] =
        sum(product(a[(d + 1) % 3], b[(d + 2) % 3]), product(a[(d + 2) % 3], b[(d + 1) % 3]), -1);
    return result;
  }

  /** Coefficients of the polynomials of Bernstein on [0, 1], times a positive number. */
  inline Polynomial
  bernstein(const Polynomial &a)
  {
    const int  degree = a.size() - 1;
    const auto choose = [](const int n, const int k) {
      int result = 1;
      for (int i = 0; i < k; ++i)
        result = result * (n - i) / (i + 1);
      return result;
    };
    Polynomial result(a.size());
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; j <= i; ++j)
        result[i] += 12 * choose(i, j) / choose(degree, j) * a[j];
    return result;
  }

  /** On the left or right half, times a positive number. */
  inline Polynomial
  half(Polynomial a, const bool right)
  {
    const std::size_t n = a.size();
    Polynomial        result(n);
    for (std::size_t i = 0; i < n; ++i)
      {
        result[right ? n - 1 - i : i] = a[right ? n - 1 - i : 0] << (n - 1 - i);
        for (std::size_t j = 0; j + i + 1 < n; ++j)
          a[j] += a[j + 1];
      }
    return result;
  }

  /** Products of a direction with the differences: it separates where all are positive. */
  using Direction = std::vector<Polynomial>;

  /** The first time in an interval at which no direction separates. Only what is not known to be
   * positive there is looked at in parts of the interval. */
  inline std::optional<double>
  first_time(std::vector<Direction> directions,
             const double           begin,
             const double           width,
             const unsigned int     depth)
  {
    std::vector<Direction> left;
    for (Direction &direction : directions)
      {
        Direction unknown;
        bool      nowhere = false;
        for (Polynomial &p : direction)
          {
            const auto positive = [](const Integer &x) { return x > 0; };
            nowhere             = nowhere || std::none_of(p.begin(), p.end(), positive);
            if (!std::all_of(p.begin(), p.end(), positive))
              unknown.push_back(std::move(p));
          }
        if (unknown.empty())
          return {};
        if (!nowhere)
          left.push_back(std::move(unknown));
      }
    if (left.empty() || depth == 0)
      return begin;
    for (const bool right : {false, true})
      {
        std::vector<Direction> halves = left;
        for (Direction &direction : halves)
          for (Polynomial &p : direction)
            p = half(p, right);
        if (const auto time =
              first_time(std::move(halves), begin + right * width / 2., width / 2., depth - 1))
          return time;
      }
    return {};
  }

  /** A direction and its products with all differences. */
  inline Direction
  products(const Path &path, const std::vector<Path> &x, const int sign)
  {
    Direction direction;
    for (const Path &p : x)
      {
        direction.push_back(bernstein(dot(path, p)));
        for (Integer &coefficient : direction.back())
          coefficient *= sign;
      }
    return direction;
  }

  /** The first time at which the hull of the differences contains zero. */
  inline std::optional<double>
  first_time(const std::vector<Path> &x)
  {
    std::vector<Direction> directions;
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        for (std::size_t k = 0; k < j; ++k)
          for (const int sign : {1, -1})
            directions.push_back(
              products(cross(difference(x[j], x[i]), difference(x[k], x[i])), x, sign));
    // Most motions end here.
    if (!first_time(directions, 0., 1., 0))
      return {};
    for (std::size_t i = 0; i < x.size(); ++i)
      {
        directions.push_back(products(x[i], x, 1));
        for (std::size_t j = 0; j < i; ++j)
          {
            // The part of x[i] that is orthogonal to the edge, times the square of the edge.
            const Path edge = difference(x[j], x[i]);
            directions.push_back(products(cross(edge, cross(x[i], edge)), x, 1));
          }
      }
    return first_time(std::move(directions), 0., 1., 100);
  }

  inline bool
  boxes_apart(const Points &start, const Points &end, const unsigned int n_of_first)
  {
    for (unsigned int d = 0; d < 3; ++d)
      {
        std::array<double, 2> lower{{1e300, 1e300}}, upper{{-1e300, -1e300}};
        for (unsigned int i = 0; i < 4; ++i)
          {
            const unsigned int side = i < n_of_first ? 0 : 1;
            lower[side]             = std::min({lower[side], start[i][d], end[i][d]});
            upper[side]             = std::max({upper[side], start[i][d], end[i][d]});
          }
        if (lower[0] > upper[1] || lower[1] > upper[0])
          return true;
      }
    return false;
  }

  /** The first time at which a node (@p n_of_first = 1) is on a triangle, or two edges (2) have a
   * point in common. */
  inline std::optional<double>
  first_time(const Points &start, const Points &end, const unsigned int n_of_first)
  {
    if (boxes_apart(start, end, n_of_first))
      return {};
    // The last bit of any coordinate.
    int lowest = 2000;
    for (const Points &points : {start, end})
      for (const auto &point : points)
        for (unsigned int d = 0; d < 3; ++d)
          if (point[d] != 0.)
            lowest = std::min(lowest, std::ilogb(point[d]) - 52);
    std::array<Path, 4> paths;
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int d = 0; d < 3; ++d)
        {
          const auto integer = [&](const double x) {
            int                exponent = 0;
            const std::int64_t mantissa = std::ldexp(std::frexp(x, &exponent), 53);
            return x == 0. ? Integer(0) : Integer(mantissa) << (exponent - 53 - lowest);
          };
          const Integer first = integer(start[i][d]), second = integer(end[i][d]);
          paths[i][d] = {first, second - first};
        }
    std::vector<Path> differences;
    for (unsigned int i = 0; i < n_of_first; ++i)
      for (unsigned int j = n_of_first; j < 4; ++j)
        differences.push_back(difference(paths[i], paths[j]));
    return first_time(differences);
  }

  /** Number of nodes on triangles and of edges through edges at any time between two states, but
   * for those that have a node in common. Looks at all combinations. */
  inline std::size_t
  count_crossings(const std::vector<std::array<unsigned int, 3>> &triangles,
                  const std::vector<std::array<unsigned int, 2>> &edges,
                  const std::vector<dealii::Point<3>>            &start,
                  const std::vector<dealii::Point<3>>            &end)
  {
    std::size_t count = 0;
    for (unsigned int node = 0; node < start.size(); ++node)
      for (const auto &[a, b, c] : triangles)
        if (node != a && node != b && node != c)
          count += first_time(Points{{start[node], start[a], start[b], start[c]}},
                              Points{{end[node], end[a], end[b], end[c]}},
                              1)
                     .has_value();
    for (std::size_t i = 0; i < edges.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        {
          const auto [a, b] = edges[i];
          const auto [c, d] = edges[j];
          if (a != c && a != d && b != c && b != d)
            count += first_time(Points{{start[a], start[b], start[c], start[d]}},
                                Points{{end[a], end[b], end[c], end[d]}},
                                2)
                       .has_value();
        }
    return count;
  }
} // namespace BruteForce

#endif
