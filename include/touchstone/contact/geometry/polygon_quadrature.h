// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_polygon_quadrature_h
#define touchstone_contact_geometry_polygon_quadrature_h

#include <touchstone/contact/geometry/straight_corners.h>

#include <deal.II/base/quadrature_lib.h>

namespace Touchstone
{
  namespace internal
  {
    /** The centroid of a polygon that is not degenerate. */
    template <typename Number>
    Point2<Number>
    centroid(const Polygon<Number> &corners)
    {
      const Point2<Number> origin = corners[0];
      Number               sum = 0., x = 0., y = 0.;
      for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        {
          // Each triangle (origin, i, i + 1) counts at the mean of its corners.
          const Point2<Number> a = corners[i] - origin, b = corners[i + 1] - origin;
          const Number         double_area = cross(a, b);
          sum += double_area;
          x += double_area * (a.x + b.x);
          y += double_area * (a.y + b.y);
        }
      return {origin.x + x / (3. * sum), origin.y + y / (3. * sum)};
    }

    /** Visit the points of @p rule on the triangle with the corners @p origin, @p origin + @p a and
     * @p origin + @p b. */
    template <typename Number, typename Visitor>
    void
    for_each_point_of_triangle(const dealii::Quadrature<2> &rule,
                               const Point2<Number>        &origin,
                               const Point2<Number>        &a,
                               const Point2<Number>        &b,
                               const Visitor               &visit)
    {
      const Number double_area = cross(a, b);
      for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const double r = rule.point(q)[0], s = rule.point(q)[1];
          visit(Point2<Number>{origin.x + r * a.x + s * b.x, origin.y + r * a.y + s * b.y},
                Number(rule.weight(q) * double_area));
        }
    }

    /** The same on a quadrilateral, bilinear. */
    template <typename Number, typename Visitor>
    void
    for_each_point_of_quadrilateral(const dealii::Quadrature<2> &rule,
                                    const Polygon<Number>       &corners,
                                    const Visitor               &visit)
    {
      // origin + r a + s c + r s (b - a - c)
      const Point2<Number> origin = corners[0], a = corners[1] - origin, b = corners[2] - origin,
                           c = corners[3] - origin;
      const Point2<Number> mixed{b.x - a.x - c.x, b.y - a.y - c.y};
      for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const double         r = rule.point(q)[0], s = rule.point(q)[1];
          const Point2<Number> by_r{a.x + s * mixed.x, a.y + s * mixed.y};
          const Point2<Number> by_s{c.x + r * mixed.x, c.y + r * mixed.y};
          visit(Point2<Number>{origin.x + r * by_r.x + s * c.x, origin.y + r * by_r.y + s * c.y},
                Number(rule.weight(q) * cross(by_r, by_s)));
        }
    }

    /** Visit the points of the rule for a polygon of this number of corners. The rules of a
     * triangle and of a square are symmetric; a polygon of more corners is divided into triangles
     * from its centroid (Puso and Laursen 2004), not from one of its corners. */
    template <typename Number, typename Visitor>
    void
    for_each_point_of_polygon(const Polygon<Number> &corners,
                              const unsigned int     degree,
                              const Visitor         &visit)
    {
      using namespace dealii;
      // Products of two functions of this degree in both directions: 4 or 8 in all. A bilinear map
      // adds one in each direction by its Jacobian.
      static const QGauss<2>                   squares[2]   = {QGauss<2>(3), QGauss<2>(5)};
      static const QWitherdenVincentSimplex<2> triangles[2] = {QWitherdenVincentSimplex<2>(3),
                                                               QWitherdenVincentSimplex<2>(5)};
      // Of these there are many in a polygon: points for no higher degree than needed.
      static const QWitherdenVincentSimplex<2> sectors[2] = {
        QWitherdenVincentSimplex<2>(2, /*use_odd_order=*/false),
        QWitherdenVincentSimplex<2>(4, /*use_odd_order=*/false)};
      const std::size_t n = corners.size();
      if (n == 3)
        for_each_point_of_triangle(triangles[degree - 1],
                                   corners[0],
                                   corners[1] - corners[0],
                                   corners[2] - corners[0],
                                   visit);
      else if (n == 4)
        for_each_point_of_quadrilateral(squares[degree - 1], corners, visit);
      else
        {
          const Point2<Number> centre = centroid(corners);
          for (std::size_t i = 0; i < n; ++i)
            for_each_point_of_triangle(sectors[degree - 1],
                                       centre,
                                       corners[i] - centre,
                                       corners[(i + 1) % n] - centre,
                                       visit);
        }
    }
  } // namespace internal



  /** @brief Visit quadrature points of a polygon, with weights that integrate products of two shape
   * functions of this @p degree exactly on plane facets that are parallelograms. On others shape
   * functions are rational, and on curved surfaces gaps and normals are no polynomials: there an
   * error is left, which must not depend on the corner that comes first, for numbers of nodes,
   * mirrored meshes or round-off would change it, nor on where nearly straight corners are (see
   * StraightCorners). */
  template <typename Number, typename Visitor>
  void
  for_each_point(const Polygon<Number> &corners, const unsigned int degree, const Visitor &visit)
  {
    if (!has_straight_corners(corners))
      {
        internal::for_each_point_of_polygon(corners, degree, visit);
        return;
      }
    const StraightCorners<Number> parts(corners);
    parts.for_each_part([&](const Polygon<Number> &part, const Number &share) {
      internal::for_each_point_of_polygon(part, degree, [&](const auto &point, const auto &weight) {
        visit(point, Number(share * weight));
      });
    });
  }
} // namespace Touchstone

#endif
