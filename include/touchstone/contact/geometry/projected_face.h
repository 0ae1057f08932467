// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_projected_face_h
#define touchstone_contact_geometry_projected_face_h

#include <touchstone/contact/geometry/bilinear.h>
#include <touchstone/contact/geometry/face.h>
#include <touchstone/contact/geometry/polygon.h>
#include <touchstone/contact/geometry/value_of.h>
#include <touchstone/contact/geometry/vector3.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/quadrature_lib.h>

#include <array>
#include <cmath>
#include <utility>

namespace Touchstone
{
  /** @brief Present positions of the nodes of a face.
   * @tparam Number double, or a number that carries derivatives (Sacado), as in all below. */
  template <typename Number>
  using Positions = std::array<Vector3<Number>, Face::max_nodes>;

  Positions<double>
  positions(const Face &face);

  /** @brief The tangent plane at the centre of a face, onto which faces are projected to be
   * intersected (doc/theory.md 3). Puso (2004), Int. J. Numer. Meth. Engng 59. */
  template <typename Number>
  struct TangentPlane
  {
    Vector3<Number> origin, e1, e2;
    /** Of the first tangent, and of the parallelogram of both. */
    Number length, area;

    TangentPlane(const Face &face, const Positions<Number> &x)
    {
      const FaceShapes shapes(face.degree, {{0., 0.}});
      Vector3<Number>  t[2];
      for (unsigned int d = 0; d < dim; ++d)
        {
          origin[d] = 0.;
          for (auto &tangent : t)
            tangent[d] = 0.;
          for (unsigned int m = 0; m < face.n_nodes(); ++m)
            {
              origin[d] += shapes.value[m] * x[m][d];
              for (unsigned int a = 0; a < 2; ++a)
                t[a][d] += shapes.gradient[m][a] * x[m][d];
            }
        }
      using std::sqrt;
      Vector3<Number> normal = cross(t[0], t[1]);
      area                   = sqrt(dot(normal, normal));
      length                 = sqrt(dot(t[0], t[0]));
      for (unsigned int d = 0; d < dim; ++d)
        {
          normal[d] /= area;
          e1[d] = t[0][d] / length;
        }
      e2 = cross(normal, e1);
    }
  };

  /** @brief A face projected onto a plane. */
  template <typename Number>
  struct ProjectedFace
  {
    const Face                                 &face;
    std::array<Point2<Number>, Face::max_nodes> nodes;
    Bilinear<2>                                 bilinear; // if of degree 1

    /** @param x Positions of its nodes. */
    ProjectedFace(const Face &face, const Positions<Number> &x, const TangentPlane<Number> &plane)
      : face(face)
    {
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        {
          Vector3<Number> y = x[m];
          for (unsigned int d = 0; d < dim; ++d)
            y[d] -= plane.origin[d];
          nodes[m] = {dot(y, plane.e1), dot(y, plane.e2)};
        }
      if (face.degree == 1)
        bilinear = Bilinear<2>([this](const unsigned int m, const unsigned int d) {
          return value_of(d == 0 ? nodes[m].x : nodes[m].y);
        });
    }

    /** @brief The bilinear pieces, counterclockwise: one, or the four of a biquadratic face. */
    boost::container::static_vector<Polygon<Number>, 4>
    pieces() const
    {
      boost::container::static_vector<Polygon<Number>, 4> result;
      const unsigned int                                  p = face.degree;
      for (unsigned int j = 0; j < p; ++j)
        for (unsigned int i = 0; i < p; ++i)
          {
            const unsigned int m = i + (p + 1) * j;
            Polygon<Number>    piece{nodes[m], nodes[m + 1], nodes[m + p + 2], nodes[m + p + 1]};
            if (area(piece) < 0.)
              std::swap(piece[1], piece[3]);
            result.push_back(piece);
          }
      return result;
    }

    /** @brief Position and tangents @p t, without derivatives. */
    Point2<double>
    evaluate(const FaceShapes &shapes, Point2<double> (&t)[2]) const
    {
      Point2<double> position{0., 0.};
      t[0] = t[1] = {0., 0.};
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        {
          const double x = value_of(nodes[m].x), y = value_of(nodes[m].y);
          position.x += shapes.value[m] * x;
          position.y += shapes.value[m] * y;
          for (unsigned int a = 0; a < 2; ++a)
            {
              t[a].x += shapes.gradient[m][a] * x;
              t[a].y += shapes.gradient[m][a] * y;
            }
        }
      return position;
    }

    /** @brief Face coordinates @p xi of a point of the plane, by Newton's method.
     * @return false if there are none near the face. */
    bool
    invert(const Point2<double> &x, std::array<double, 2> &xi) const;
  };

  /** @brief Whether the boxes around two projected faces are no closer than @p distance. */
  bool
  apart(const ProjectedFace<double> &a, const ProjectedFace<double> &b, double distance = 0.);

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

    /** Visit points of a polygon, with weights that integrate products of two shape functions
     * exactly on plane facets that are parallelograms. On others shape functions are rational, and
     * on curved surfaces gaps and normals are no polynomials: there an error is left, which must
     * not depend on the corner that comes first, for numbers of nodes, mirrored meshes or round-off
     * would change it. The rules of a triangle and of a square are symmetric; a polygon of more
     * corners is divided into triangles from its centroid (Puso and Laursen 2004), not from one
     * of its corners. */
    template <typename Number, typename Visitor>
    void
    for_each_point(const Polygon<Number> &corners, const unsigned int degree, const Visitor &visit)
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



  /** @brief Visit the quadrature points on the common parts of two projected faces, with position
   * and weight in the plane, and their corners with weight zero. The polygons are clipped exactly,
   * each piece of one face by each of the other. */
  template <typename Number, typename Visitor>
  void
  for_each_common_point(const ProjectedFace<Number> &slave,
                        const ProjectedFace<Number> &master,
                        const Visitor               &visit)
  {
    const auto master_pieces = master.pieces();
    for (const Polygon<Number> &window : slave.pieces())
      {
        const double whole = value_of(area(window));
        for (const Polygon<Number> &piece : master_pieces)
          {
            Polygon<Number> common = clip(piece, window);
            if (common.size() < 3 || area(common) < Tolerances::sliver * whole)
              continue;
            remove_flat_corners(common, Tolerances::sliver * whole);
            internal::for_each_point(common, slave.face.degree, visit);
            for (const Point2<Number> &corner : common)
              visit(corner, Number(0.));
          }
      }
  }
} // namespace Touchstone

#endif
