// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/overlap.h>
#include <touchstone/contact/geometry/projected_face.h>

#include <algorithm>
#include <cmath>

// Faces projected on a plane: the inverse of their maps, by which quadrature points on the overlap
// get coordinates on both faces, and a quick test that two faces are apart.
namespace Touchstone
{
  using namespace dealii;

  Positions<double>
  positions(const Face &face)
  {
    Positions<double> result;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      for (unsigned int d = 0; d < dim; ++d)
        result[m][d] = face.reference[m][d] + face.displacement[m][d];
    return result;
  }



  namespace
  {
    constexpr unsigned int max_inversion_steps = 20;

    /** Whether @p xi are coordinates of a point on a face or not far beside it. Where the map of a
     * distorted face folds, Newton's method may converge to a point far away. */
    bool
    near_face(const std::array<double, 2> &xi)
    {
      return std::abs(xi[0]) < 1.5 && std::abs(xi[1]) < 1.5;
    }

    /** Solve map(xi) = x by Newton's method.
     * @return false if the solution is not near the face. */
    bool
    invert_bilinear(const Bilinear<2> &map, const Point2<double> &x, std::array<double, 2> &xi)
    {
      // x(xi) = c_0 + c_1 xi_1 + c_2 xi_2 + c_3 xi_1 xi_2. The residual after a Newton step is -d_1
      // d_2 c_3 exactly, so the position need not be evaluated again.
      const auto          &c = map.c;
      const Point2<double> mixed{c[3][0], c[3][1]};
      Point2<double>       t[2] = {{c[1][0], c[1][1]}, {c[2][0], c[2][1]}};
      Point2<double>       r{x.x - c[0][0], x.y - c[0][1]};
      xi = {{0., 0.}};
      for (unsigned int iteration = 0; iteration < max_inversion_steps; ++iteration)
        {
          const double jacobian = cross(t[0], t[1]);
          if (jacobian == 0.)
            return false;
          const double inverse = 1. / jacobian;
          const double d[2]    = {inverse * cross(r, t[1]), inverse * cross(t[0], r)};
          xi[0] += d[0];
          xi[1] += d[1];
          // A step leaves nothing but its mixed term.
          r = {-d[0] * d[1] * mixed.x, -d[0] * d[1] * mixed.y};
          if (r.x * r.x + r.y * r.y < 1e-30 * std::abs(jacobian))
            break;
          t[0] = {c[1][0] + xi[1] * mixed.x, c[1][1] + xi[1] * mixed.y};
          t[1] = {c[2][0] + xi[0] * mixed.x, c[2][1] + xi[0] * mixed.y};
        }
      return near_face(xi);
    }
  } // namespace



  template <typename Number>
  bool
  ProjectedFace<Number>::invert(const Point2<double> &x, std::array<double, 2> &xi) const
  {
    if (face.degree == 1)
      return invert_bilinear(bilinear, x, xi);
    xi = {{0., 0.}};
    for (unsigned int iteration = 0; iteration < max_inversion_steps; ++iteration)
      {
        // Biquadratic faces: Newton's method with the full map.
        Point2<double>       t[2];
        const Point2<double> position = evaluate(FaceShapes(face.degree, xi), t);
        const Point2<double> r{x.x - position.x, x.y - position.y};
        const double         jacobian = cross(t[0], t[1]);
        if (jacobian == 0.)
          return false;
        const double d[2] = {cross(r, t[1]) / jacobian, cross(t[0], r) / jacobian};
        xi[0] += d[0];
        xi[1] += d[1];
        // Convergence is quadratic: the remaining error is about the square of this step.
        if (std::abs(d[0]) + std::abs(d[1]) < 1e-8)
          break;
      }
    return near_face(xi);
  }

  template struct ProjectedFace<double>;
  template struct ProjectedFace<
    Sacado::Fad::SFad<double, int(OverlapPointDerivative<4>::n_variables)>>;
  template struct ProjectedFace<
    Sacado::Fad::SFad<double, int(OverlapPointDerivative<9>::n_variables)>>;



  bool
  apart(const ProjectedFace<double> &a, const ProjectedFace<double> &b, const double distance)
  {
    const auto range = [](const ProjectedFace<double> &face, double Point2<double>::*const axis) {
      const auto end = face.nodes.begin() + face.face.n_nodes();
      const auto [low, high] =
        std::minmax_element(face.nodes.begin(), end, [&](const auto &p, const auto &q) {
          return p.*axis < q.*axis;
        });
      return std::make_pair((*low).*axis, (*high).*axis);
    };
    for (const auto axis : {&Point2<double>::x, &Point2<double>::y})
      {
        // Bounding boxes along the axes of the plane: no overlap of the boxes, no overlap of the
        // faces.
        const auto of_a = range(a, axis), of_b = range(b, axis);
        if (of_a.second + distance <= of_b.first || of_b.second + distance <= of_a.first)
          return true;
      }
    return false;
  }
} // namespace Touchstone
