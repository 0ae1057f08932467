// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/edge_normal.h>
#include <touchstone/contact/pairing/smooth_step.h>

#include <cmath>

// Normals that turn to those which faces have in common beside their edges (doc/theory.md 4,
// "Normals").
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** From this face coordinate on the normal turns to that of the edge, within a twentieth of the
     * face, which is how far from an edge a node can come to rest that belongs on it. It lies on
     * one of the two faces there, and within neither. Over less than a fiftieth normals that differ
     * by up to 50 degrees turn faster than changes_steeply() lets Newton's method follow. */
    constexpr double beside_edge = 0.9;

    /** 0 within the face and at the end of the surface, 1 on edges to other faces.
     * @param decides Set to the coordinate on which it depends. */
    double
    at_edge(const Face &face, const std::array<double, 2> &xi, unsigned int &decides)
    {
      double result = 0.;
      decides       = 0;
      for (unsigned int a = 0; a < 2; ++a)
        if (!(face.ends() & (1u << (2 * a + (xi[a] > 0. ? 1 : 0)))))
          if (const double part = smooth_step(std::abs(xi[a]), beside_edge, 1.); part > result)
            {
              result  = part;
              decides = a;
            }
      return result;
    }

    /** Whether the normal jumps over edges: that of each face alone, and that of a moved exact
     * surface by the part of the strain that nodal normals do not take out of it. */
    bool
    jumps_over_edges(const FaceGeometry &geometry)
    {
      return !geometry.smooth() &&
             (!geometry.interpolates_normals() || geometry.exact_surface() != nullptr);
    }

    /** The face with the normal on its edges, interpolated from those of the nodes of the edge
     * alone, which other faces have in common with it. */
    FaceGeometry
    with_common_normal(const Face &face)
    {
      return {face, nullptr, MasterNormal::averaged};
    }
  } // namespace



  Tensor<1, dim>
  normal_over_edges(const FaceGeometry          &geometry,
                    const std::array<double, 2> &xi,
                    const FacePoint             &point)
  {
    const FaceShapes     shapes(geometry.face().degree, xi);
    const Tensor<1, dim> normal = geometry.normal(shapes, point);
    unsigned int         decides;
    const double         part = at_edge(geometry.face(), xi, decides);
    if (!jumps_over_edges(geometry) || part == 0.)
      return normal;
    const FaceGeometry   common = with_common_normal(geometry.face());
    const Tensor<1, dim> sum    = (1. - part) * normal + part * common.normal(shapes, point);
    return sum / sum.norm();
  }



  FaceDerivative
  differentiate_over_edges(const FaceGeometry &geometry, const std::array<double, 2> &xi)
  {
    FaceDerivative result = FaceDifferentiator(geometry).at(xi);
    unsigned int   decides;
    const double   part = at_edge(geometry.face(), xi, decides);
    if (!jumps_over_edges(geometry) || part == 0.)
      return result;
    const FaceGeometry   common    = with_common_normal(geometry.face());
    const FaceDerivative other     = FaceDifferentiator(common).at(xi);
    const Tensor<1, dim> sum       = (1. - part) * result.normal + part * other.normal;
    const Tensor<2, dim> direction = normalisation_derivative(sum);
    for (unsigned int a = 0; a < 2; ++a)
      result.normal_xi[a] =
        direction * ((1. - part) * result.normal_xi[a] + part * other.normal_xi[a]);
    // The derivative of the cubic step: 6 t (1 - t) over its width.
    const double t     = (std::abs(xi[decides]) - beside_edge) / (1. - beside_edge),
                 slope = t < 1. ? 6. * t * (1. - t) / (1. - beside_edge) : 0.;
    result.normal_xi[decides] +=
      std::copysign(slope, xi[decides]) * (direction * (other.normal - result.normal));
    for (unsigned int m = 0; m < geometry.face().n_nodes(); ++m)
      {
        result.normal_position[m] =
          direction * ((1. - part) * result.normal_position[m] + part * other.normal_position[m]);
        result.normal_normal[m] =
          direction * ((1. - part) * result.normal_normal[m] + part * other.normal_normal[m]);
      }
    result.normal = sum / sum.norm();
    return result;
  }
} // namespace Touchstone
