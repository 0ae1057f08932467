// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_projected_face_h
#define touchstone_contact_geometry_projected_face_h

#include <touchstone/contact/geometry/bilinear.h>
#include <touchstone/contact/geometry/face.h>
#include <touchstone/contact/geometry/polygon_quadrature.h>
#include <touchstone/contact/geometry/value_of.h>
#include <touchstone/contact/geometry/vector3.h>
#include <touchstone/contact/tolerances.h>

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
            for_each_point(common, slave.face.degree, visit);
            for (const Point2<Number> &corner : common)
              visit(corner, Number(0.));
          }
      }
  }
} // namespace Touchstone

#endif
