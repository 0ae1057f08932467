// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_straight_corners_h
#define touchstone_contact_geometry_straight_corners_h

#include <touchstone/contact/geometry/polygon.h>
#include <touchstone/contact/geometry/value_of.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief The triangle of a corner with its neighbours, by the area of the polygon in which the
   * triangles of corners count as flat (Tolerances::straight_corner); positive also where the
   * corner points inwards. Below one the corner is nearly straight, or close to another. */
  template <typename Number>
  Number
  height_of_corner(const Point2<Number> &before,
                   const Point2<Number> &corner,
                   const Point2<Number> &after,
                   const Number         &area)
  {
    const Number triangle =
      cross(corner - before, after - corner) / (2. * Tolerances::straight_corner * area);
    return triangle < 0. ? Number(-triangle) : triangle;
  }

  /** @brief Whether any corner of a polygon is nearly straight. Triangles have none. */
  template <typename Number>
  bool
  has_straight_corners(const Polygon<Number> &polygon)
  {
    const std::size_t n = polygon.size();
    if (n == 3)
      return false;
    Polygon<double> values;
    for (const Point2<Number> &corner : polygon)
      values.push_back({value_of(corner.x), value_of(corner.y)});
    const double whole = area(values);
    for (std::size_t i = 0; i < n; ++i)
      if (height_of_corner(values[(i + n - 1) % n], values[i], values[(i + 1) % n], whole) < 1.)
        return true;
    return false;
  }

  /**
   * @brief A polygon as a sum of polygons without its nearly straight corners and of the triangles
   * that these form with their neighbours, each with a share between 0 and 1
   * (doc/theory.md 3, "Nearly straight corners").
   *
   * Where two edges cross at a small angle the corner runs along them by 1 / angle for the smallest
   * motion. What a quadrature leaves must not run with it: an exactly straight corner takes part in
   * nothing but its triangle. The shares change with the corner's height, so that the sum is a
   * smooth function of the corners, and do not depend on their order.
   */
  template <typename Number>
  class StraightCorners
  {
  public:
    /** Divide a polygon of positive area; it must live as long as this. */
    explicit StraightCorners(const Polygon<Number> &corners)
      : corners(corners)
    {
      std::vector<unsigned int> all(corners.size());
      std::iota(all.begin(), all.end(), 0);
      polygons[all.size()].emplace(all, Number(1.));
      for (std::size_t n = all.size(); n > 3; --n)
        for (auto &[numbers, share] : polygons[n])
          divide(numbers, share);
    }

    /** @brief Call @p visit with each polygon and its share; together they are the whole one. */
    template <typename Visitor>
    void
    for_each_part(const Visitor &visit) const
    {
      for (const auto &of_size : polygons)
        for (const auto &[numbers, share] : of_size)
          if (value_of(share) > 0.)
            visit(polygon(numbers), share);
      for (const auto &[numbers, share] : triangles)
        visit(Polygon<Number>{corners[numbers[0]], corners[numbers[1]], corners[numbers[2]]},
              share);
    }

  private:
    /** Numbers of corners and the share of their polygon. */
    using Shares = std::map<std::vector<unsigned int>, Number>;

    const Polygon<Number> &corners;

    /** By the number of corners; and triangles that were cut off. */
    std::array<Shares, Polygon<Number>::static_capacity + 1> polygons;
    Shares                                                   triangles;

    Polygon<Number>
    polygon(const std::vector<unsigned int> &numbers) const
    {
      Polygon<Number> result;
      for (const unsigned int i : numbers)
        result.push_back(corners[i]);
      return result;
    }

    static void
    add(Shares &shares, const std::vector<unsigned int> &numbers, const Number &share)
    {
      const auto [entry, is_new] = shares.emplace(numbers, share);
      if (!is_new)
        entry->second += share;
    }

    /** Move parts of the @p share of a polygon to those with one corner less. */
    void
    divide(const std::vector<unsigned int> &numbers, Number &share)
    {
      const std::size_t n     = numbers.size();
      const Number      whole = area(polygon(numbers));
      // The weight of the polygon as it is is one, that without a corner grows with the inverse
      // square of the corner's height h: what other corners contribute falls faster with h than
      // where this corner is changes (by 1 / h).
      std::vector<std::pair<std::size_t, Number>> weights;
      Number                                      sum = 1.;
      for (std::size_t i = 0; i < n; ++i)
        {
          Number height = height_of_corner(corners[numbers[(i + n - 1) % n]],
                                           corners[numbers[i]],
                                           corners[numbers[(i + 1) % n]],
                                           whole);
          if (height >= 1.)
            continue;
          if (height < Tolerances::equally_straight)
            height = Tolerances::equally_straight;
          const Number root = 1. / height - 1.;
          weights.emplace_back(i, root * root);
          sum += weights.back().second;
        }
      if (weights.empty())
        return;
      // What is too small to change anything is left out.
      const double least = Tolerances::smallest_share * value_of(sum);
      weights.erase(std::remove_if(weights.begin(),
                                   weights.end(),
                                   [&](const auto &weight) {
                                     return value_of(weight.second) < least;
                                   }),
                    weights.end());
      const bool stays = least <= 1.;
      sum              = stays ? 1. : 0.;
      for (const auto &weight : weights)
        sum += weight.second;
      for (const auto &[i, weight] : weights)
        {
          const Number              part = share * weight / sum;
          std::vector<unsigned int> rest = numbers;
          rest.erase(rest.begin() + i);
          add(polygons[n - 1], rest, part);
          std::vector<unsigned int> cut{numbers[(i + n - 1) % n], numbers[i], numbers[(i + 1) % n]};
          add(triangles, cut, part);
        }
      if (stays)
        share /= sum;
      else
        share = 0.;
    }
  };
} // namespace Touchstone

#endif
