// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/measured_face.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <cmath>
#include <limits>
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



  // The product of the tangents of a bilinear face is linear in its coordinates, and so its angle
  // to a direction is bounded at the corners. Along the normal here, points of the other face lie
  // no lower than 'lowest' and those of this one no higher than 'highest'; a point d behind a face
  // with the normal N is d |N . normal| or more behind a point of that face along the direction.
  bool
  MeasuredFace::clear_of(const Face &other, const double least) const
  {
    if (face.degree != 1 || exact != nullptr || other.degree != 1)
      return false;
    double lowest = std::numeric_limits<double>::max(), highest = -lowest;
    for (unsigned int m = 0; m < 4; ++m)
      {
        highest = std::max(highest, (face.position(m) - centre.x) * normal);
        lowest  = std::min(lowest, (other.position(m) - centre.x) * normal);
      }
    const auto steepest = [&](const Face &of, const double sign) {
      double least_along = std::numeric_limits<double>::max(), longest = 0.;
      for (const auto &[corner, one, two] :
           {std::array<unsigned int, 3>{{0, 1, 2}}, {{1, 0, 3}}, {{2, 3, 0}}, {{3, 2, 1}}})
        {
          Tensor<1, dim> product = cross_product_3d(of.position(one) - of.position(corner),
                                                    of.position(two) - of.position(corner));
          if (corner == 1 || corner == 2)
            product *= -1.;
          least_along = std::min(least_along, sign * (product * normal));
          longest     = std::max(longest, product.norm());
        }
      return longest > 0. ? least_along / longest : 0.;
    };
    const double cosine = std::min(steepest(face, 1.), steepest(other, -1.));
    return cosine > 0. && highest - lowest <= cosine * least;
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



  Face
  MeasuredFace::displaced(const Face &face, const Vector &u)
  {
    Face result = face;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      for (unsigned int d = 0; d < dim; ++d)
        result.displacement[m][d] = u(dim * face.nodes[m] + d);
    return result;
  }
} // namespace Touchstone
