// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_polygon_h
#define touchstone_contact_geometry_polygon_h

#include <boost/container/static_vector.hpp>

namespace Touchstone
{
  /** @brief A point of a plane, for double and for numbers that carry derivatives
   * (Sacado): deal.II's Point does not go with the latter, whose products are expression
   * templates. */
  template <typename Number>
  struct Point2
  {
    Number x, y;
  };

  /** @brief Difference vector. */
  template <typename Number>
  Point2<Number>
  operator-(const Point2<Number> &a, const Point2<Number> &b)
  {
    return {a.x - b.x, a.y - b.y};
  }

  /** @brief Third component of the vector product. */
  template <typename Number>
  Number
  cross(const Point2<Number> &a, const Point2<Number> &b)
  {
    return a.x * b.y - a.y * b.x;
  }

  /** @brief Corners of a quadrilateral, or of what is left of it when it is cut by four
   * lines: a line that crosses k of n edges leaves at most n - k / 2 corners and adds k,
   * and k <= n, so that there are at most 4, 6, 9, 13 and 19. */
  template <typename Number>
  using Polygon = boost::container::static_vector<Point2<Number>, 19>;

  /** @brief Area of a polygon, positive if it is counterclockwise. */
  template <typename Number>
  Number
  area(const Polygon<Number> &polygon)
  {
    Number sum = 0.;
    for (std::size_t i = 2; i < polygon.size(); ++i)
      sum += 0.5 * cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return sum;
  }

  /** @brief Remove corners at which the polygon is straight or whose edges are very short: those
   * whose triangle with their neighbours is smaller than @p smallest. Round-off adds such
   * corners and takes them away again where two quadrilaterals have an edge in common. */
  template <typename Number>
  void
  remove_flat_corners(Polygon<Number> &polygon, const double smallest)
  {
    for (std::size_t i = 0; i < polygon.size() && polygon.size() > 3;)
      {
        const std::size_t     n      = polygon.size();
        const Point2<Number> &before = polygon[(i + n - 1) % n], &after = polygon[(i + 1) % n];
        const Number          triangle = 0.5 * cross(polygon[i] - before, after - polygon[i]);
        if (triangle < smallest && triangle > -smallest)
          polygon.erase(polygon.begin() + i);
        else
          ++i;
      }
  }

  /** @brief The part of a quadrilateral @p subject within the convex, counterclockwise
   * quadrilateral @p window. Sutherland and Hodgman (1974), Commun. ACM 17. */
  template <typename Number>
  Polygon<Number>
  clip(Polygon<Number> subject, const Polygon<Number> &window)
  {
    for (std::size_t e = 0; e < window.size() && !subject.empty(); ++e)
      {
        const Point2<Number> &a    = window[e];
        const Point2<Number>  edge = window[(e + 1) % window.size()] - a;
        boost::container::static_vector<Number, Polygon<Number>::static_capacity> side;
        bool                                                                      all = true;
        for (const Point2<Number> &p : subject)
          {
            side.push_back(cross(edge, p - a));
            all = all && side.back() >= 0.;
          }
        if (all)
          continue;
        Polygon<Number> result;
        for (std::size_t i = 0; i < subject.size(); ++i)
          {
            const std::size_t     j  = (i + 1) % subject.size();
            const Point2<Number> &p  = subject[i];
            const Number         &dp = side[i], &dq = side[j];
            if (dp >= 0.)
              result.push_back(p);
            if ((dp > 0. && dq < 0.) || (dp < 0. && dq > 0.))
              {
                const Number t = dp / (dp - dq);
                result.push_back({p.x + t * (subject[j].x - p.x), p.y + t * (subject[j].y - p.y)});
              }
          }
        subject = result;
      }
    return subject;
  }
} // namespace Touchstone

#endif
