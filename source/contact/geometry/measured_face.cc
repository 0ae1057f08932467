// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/measured_face.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <cmath>
#include <vector>

// How deep points lie behind faces, for the search for contact that no row has seen (doc/theory.md
// 4.1).
namespace Touchstone
{
  using namespace dealii;

  MeasuredFace::MeasuredFace(const Face &face, const AnalyticSurface *exact)
    : face(face)
    , exact(exact)
    , geometry(face, exact, MasterNormal::face)
    , centre(evaluate(face, exact, Xi{{0., 0.}}))
    , normal(centre.normal())
  {
    const auto c = corners();
    side         = face.position(c[0]).distance(face.position(c[3])) / std::sqrt(2.);
    for (unsigned int k = 0; k < 4; ++k)
      {
        bulge = std::max(bulge, std::abs((face.position(c[k]) - centre.x) * normal));
        for (unsigned int l = 0; l < k && !exact && face.degree == 1; ++l)
          {
            // Height of an arc of a circle with these normals at its ends: half the chord times
            // tan(angle/4) = sin(angle/2) / (1 + cos(angle/2)).
            const Tensor<1, dim> turn   = face.normals[c[k]] - face.normals[c[l]];
            const double         cosine = std::sqrt(std::max(0., 1. - 0.25 * turn.norm_square()));
            const double         arc =
              -0.25 / (1. + cosine) * turn * (face.position(c[k]) - face.position(c[l]));
            before = std::max(before, arc);
            off    = std::max(off, std::abs(arc));
          }
      }
  }



  std::array<unsigned int, 4>
  MeasuredFace::corners() const
  {
    return {{0, face.degree, face.n_nodes() - 1 - face.degree, face.n_nodes() - 1}};
  }



  bool
  MeasuredFace::meets(const Tensor<1, dim> &other) const
  {
    return other * normal < -Tolerances::perpendicular_cosine;
  }



  std::optional<double>
  MeasuredFace::depth(const Point<dim> &x, const double least, Xi &xi) const
  {
    if ((x - centre.x) * normal > bulge - least)
      return {};
    const Projection foot = closest_point_projection(x, geometry);
    // A foot on an edge may lie beyond it by round-off on both of the faces that share it.
    if (std::max(foot.beyond_inner, foot.beyond_outer) > Tolerances::edge_end)
      return {};
    xi                    = foot.xi;
    const FacePoint point = geometry.evaluate(xi);
    return (point.x - x) * point.normal();
  }



  Tensor<1, dim>
  MeasuredFace::to_straight_edges(const Xi &xi) const
  {
    const auto c = corners();
    Point<dim> x;
    for (unsigned int k = 0; k < 4; ++k)
      x += 0.25 * (1. + (k % 2 == 0 ? -1. : 1.) * xi[0]) * (1. + (k < 2 ? -1. : 1.) * xi[1]) *
           face.position(c[k]);
    return x - geometry.evaluate(xi).x;
  }



  BoundingBox<dim>
  MeasuredFace::box_around(const Face &face, const double reach)
  {
    std::vector<Point<dim>> positions;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      positions.push_back(face.position(m));
    BoundingBox<dim> box(positions);
    box.extend(reach);
    return box;
  }



  Face
  MeasuredFace::in_reference(const Face &face)
  {
    Face result = face;
    result.displacement.fill(Tensor<1, dim>());
    return result;
  }
} // namespace Touchstone
