// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/edge_normal.h>
#include <touchstone/contact/pairing/smooth_step.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

// Derivatives of position, tangents and normal on a face by the positions and the nodal normals of
// its nodes, at a fixed xi and by xi. Pairings chain them into derivatives of rows (doc/theory.md
// 4, "Derivatives of rows"), which the consistent linearisation needs (equations (11) and (12)).
namespace Touchstone
{
  using namespace dealii;

  Tensor<2, dim>
  cross_matrix(const Tensor<1, dim> &a)
  {
    // The matrix A with A b = a x b.
    Tensor<2, dim> result;
    result[0][1] = -a[2];
    result[0][2] = a[1];
    result[1][0] = a[2];
    result[1][2] = -a[0];
    result[2][0] = -a[1];
    result[2][1] = a[0];
    return result;
  }



  Tensor<2, dim>
  normalisation_derivative(const Tensor<1, dim> &v)
  {
    const double length = v.norm();
    if (length == 0.)
      return {};
    // d(v/|v|) = (I - n n) dv / |v|. A zero vector has no direction and stays without derivative.
    const Tensor<1, dim> n      = v / length;
    Tensor<2, dim>       result = unit_symmetric_tensor<dim>();
    result -= outer_product(n, n);
    return result / length;
  }



  namespace
  {
    /** Derivative of a point or a tangent of a face by the positions of its nodes.
     * @param value The point or tangent, that of the facet and that of the arch over it.
     * @param weights Of the nodes in that of the facet.
     * @param turn facet_rotation_derivative(), null where there is no arch. */
    NodeMatrices
    derivative_on_face(const Face                                &face,
                       const Tensor<1, dim>                      &value,
                       const std::array<double, Face::max_nodes> &weights,
                       const NodeMatrices                        *turn)
    {
      NodeMatrices   result;
      Tensor<2, dim> by_turn;
      if (turn)
        {
          // Equation (8): sum w_m x_m + R a, where a motion turns R a by W_m dx_m x R a.
          Tensor<1, dim> arch = value;
          for (unsigned int m = 0; m < face.n_nodes(); ++m)
            arch -= weights[m] * face.position(m);
          by_turn = -1. * cross_matrix(arch);
        }
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        {
          if (turn)
            result[m] = by_turn * (*turn)[m];
          for (unsigned int d = 0; d < dim; ++d)
            result[m][d][d] += weights[m];
        }
      return result;
    }

    /** Derivative of the unit normal with respect to the two tangents. */
    std::array<Tensor<2, dim>, 2>
    own_normal_derivative(const FacePoint &point)
    {
      // c = t_1 x t_2: dc = -t_2 x dt_1 + t_1 x dt_2, then the derivative of c/|c|.
      const Tensor<2, dim> direction =
        normalisation_derivative(cross_product_3d(point.tangents[0], point.tangents[1]));
      return {{-1. * direction * cross_matrix(point.tangents[1]),
               direction * cross_matrix(point.tangents[0])}};
    }
  } // namespace



  std::array<NodeMatrices, 2>
  tangent_derivatives(const Face                          &face,
                      const FaceShapes                    &shapes,
                      const std::array<Tensor<1, dim>, 2> &tangents,
                      const NodeMatrices                  *turn)
  {
    std::array<NodeMatrices, 2> result;
    for (unsigned int a = 0; a < 2; ++a)
      {
        std::array<double, Face::max_nodes> weights;
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          weights[m] = shapes.gradient[m][a];
        result[a] = derivative_on_face(face, tangents[a], weights, turn);
      }
    return result;
  }



  FaceDifferentiator::FaceDifferentiator(const FaceGeometry &geometry)
    : geometry(geometry)
  {
    const Face &face = geometry.face();
    // What does not depend on xi is computed once per face: the control points of a patch, or the
    // jumps between averaged and own normals at the nodes.
    if (geometry.smooth())
      patch = std::make_unique<GregoryPatch::Derivative>(GregoryPatch::differentiate(face));
    else if (geometry.exact_surface())
      turn = std::make_unique<NodeMatrices>(facet_rotation_derivative(face));
    if (geometry.interpolates_normals() && geometry.exact_surface())
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        {
          // On an exact surface n = own normal + sum N_m (n_m - own normal at m), so the own
          // normals at the nodes are functions of all node positions, too.
          const auto       xi    = node_coordinates(face, m);
          const FacePoint  point = geometry.evaluate(xi);
          const FaceShapes shapes(face.degree, xi);
          const auto       by_tangents = own_normal_derivative(point);
          jumps[m]                     = face.normals[m] - point.normal();
          const auto tangents = tangent_derivatives(face, shapes, point.tangents, turn.get());
          for (unsigned int k = 0; k < face.n_nodes(); ++k)
            own[m][k] = by_tangents[0] * tangents[0][k] + by_tangents[1] * tangents[1][k];
        }
  }



  void
  FaceDifferentiator::differentiate_position(FaceDerivative              &result,
                                             const std::array<double, 2> &xi) const
  {
    const FaceShapes &shapes = result.shapes;
    const Face       &face   = geometry.face();
    if (!patch)
      {
        result.x_position = derivative_on_face(face, result.point.x, shapes.value, turn.get());
        result.tangent_position =
          tangent_derivatives(face, shapes, result.point.tangents, turn.get());
        return;
      }
    // The point is linear in the control points.
    const GregoryPatch::Basis basis(xi);
    for (unsigned int k = 0; k < GregoryPatch::n_control_points; ++k)
      for (unsigned int m = 0; m < 8; ++m)
        {
          const Tensor<2, dim> &d = (*patch)[k][m];
          // Control points depend on four positions and on four nodal normals.
          const bool         p = m < 4;
          const unsigned int i = m % 4;
          (p ? result.x_position : result.x_normal)[i] += basis.value[k] * d;
          for (unsigned int a = 0; a < 2; ++a)
            (p ? result.tangent_position : result.tangent_normal)[a][i] += basis.gradient[k][a] * d;
        }
  }



  void
  FaceDifferentiator::differentiate_own_normal(FaceDerivative              &result,
                                               const std::array<double, 2> &xi) const
  {
    const auto by_tangents = own_normal_derivative(result.point);
    // The normal changes along xi with the tangents, by the second derivatives 11, 12, 22.
    const auto second = geometry.second_derivatives(xi);
    for (unsigned int b = 0; b < 2; ++b)
      result.normal_xi[b] = by_tangents[0] * second[b] + by_tangents[1] * second[b + 1];
    for (unsigned int m = 0; m < geometry.face().n_nodes(); ++m)
      for (unsigned int a = 0; a < 2; ++a)
        if (!patch && !turn)
          result.normal_position[m] += result.shapes.gradient[m][a] * by_tangents[a];
        else
          {
            result.normal_position[m] += by_tangents[a] * result.tangent_position[a][m];
            if (patch)
              result.normal_normal[m] += by_tangents[a] * result.tangent_normal[a][m];
          }
  }



  void
  FaceDifferentiator::differentiate_interpolated_normal(FaceDerivative       &result,
                                                        const Tensor<1, dim> &own_normal) const
  {
    // n = s / |s|: s = sum_m N_m n_m on facets; on an exact surface its own normal with the
    // jumps at the nodes taken out (doc/theory.md 4, "Normals").
    const Face        &face   = geometry.face();
    const unsigned int n      = face.n_nodes();
    const FaceShapes  &shapes = result.shapes;
    Tensor<1, dim>     sum;
    // The nodal normals n_m are differentiated elsewhere (NormalDerivative); here n depends on them
    // with the shape N_m, and on positions over the own normals.
    if (geometry.exact_surface())
      {
        sum = own_normal;
        for (unsigned int m = 0; m < n; ++m)
          {
            sum += shapes.value[m] * jumps[m];
            for (unsigned int b = 0; b < 2; ++b)
              result.normal_xi[b] += shapes.gradient[m][b] * jumps[m];
            for (unsigned int k = 0; k < n; ++k)
              result.normal_position[k] -= shapes.value[m] * own[m][k];
          }
      }
    else
      for (unsigned int m = 0; m < n; ++m)
        {
          sum += shapes.value[m] * face.normals[m];
          for (unsigned int b = 0; b < 2; ++b)
            result.normal_xi[b] += shapes.gradient[m][b] * face.normals[m];
        }
    // All derivatives so far are those of the sum s; the derivative of s/|s| is applied last.
    result.normal                  = sum / sum.norm();
    const Tensor<2, dim> direction = normalisation_derivative(sum);
    for (unsigned int b = 0; b < 2; ++b)
      result.normal_xi[b] = direction * result.normal_xi[b];
    for (unsigned int m = 0; m < n; ++m)
      {
        // Through the normalisation s/|s| only the part perpendicular to n remains.
        result.normal_normal[m] = shapes.value[m] * direction;
        if (geometry.exact_surface())
          result.normal_position[m] = direction * result.normal_position[m];
      }
  }



  FaceDerivative
  FaceDifferentiator::at(const std::array<double, 2> &xi) const
  {
    FaceDerivative result{FaceShapes(geometry.face().degree, xi),
                          geometry.evaluate(xi),
                          {},
                          {},
                          {},
                          {},
                          {},
                          {},
                          {},
                          {}};
    differentiate_position(result, xi);
    // The normal of the surface itself, unless the normal is interpolated from the nodes alone.
    // Which of the contributions to the normal exist depends on "Master normal" and on the exact
    // surface; see FaceGeometry::normal().
    const bool           interpolated = geometry.interpolates_normals();
    const Tensor<1, dim> own_normal   = result.point.normal();
    if (!interpolated || geometry.exact_surface())
      differentiate_own_normal(result, xi);
    if (interpolated)
      differentiate_interpolated_normal(result, own_normal);
    else
      result.normal = own_normal;
    return result;
  }



  FacePosition
  FaceDifferentiator::position(const std::array<double, 2> &xi) const
  {
    const Face &face = geometry.face();
    // Position alone: all that the slave side of a gap needs, as the normal is that of the master.
    FacePosition result{FaceShapes(face.degree, xi), geometry.evaluate(xi), {}, {}};
    if (patch)
      {
        const GregoryPatch::Basis basis(xi);
        for (unsigned int k = 0; k < GregoryPatch::n_control_points; ++k)
          for (unsigned int m = 0; m < 8; ++m)
            (m < 4 ? result.x_position : result.x_normal)[m % 4] += basis.value[k] * (*patch)[k][m];
      }
    else
      result.x_position = derivative_on_face(face, result.point.x, result.shapes.value, turn.get());
    return result;
  }



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
