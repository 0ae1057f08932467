// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/face_derivative.h>

#include <deal.II/base/symmetric_tensor.h>

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
     * @param following What of it turns with the normals.
     * @param turn facet_rotation_derivative(), null where there is no arch. */
    NodeMatrices
    derivative_on_face(const Face                                &face,
                       const Tensor<1, dim>                      &value,
                       const std::array<double, Face::max_nodes> &weights,
                       const Tensor<1, dim>                      &following,
                       const NodeMatrices                        *turn)
    {
      NodeMatrices   result;
      Tensor<2, dim> by_turn;
      if (turn)
        {
          // Equation (8): sum w_m x_m + R a, where a motion turns R a by W_m dx_m x R a.
          Tensor<1, dim> arch = value - following;
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
                      const NodeMatrices                  *turn,
                      const FollowingArch::Part           &part)
  {
    std::array<NodeMatrices, 2> result;
    for (unsigned int a = 0; a < 2; ++a)
      {
        std::array<double, Face::max_nodes> weights;
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          weights[m] = shapes.gradient[m][a];
        result[a] =
          derivative_on_face(face,
                             tangents[a],
                             weights,
                             part.value_xi[a] * part.normal + part.value * part.normal_xi[a],
                             turn);
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
          const auto part              = geometry.following_part(shapes, xi);
          const auto tangents = tangent_derivatives(face, shapes, point.tangents, turn.get(), part);
          for (unsigned int k = 0; k < face.n_nodes(); ++k)
            own[m][k] = by_tangents[0] * tangents[0][k] + by_tangents[1] * tangents[1][k];
          // The arch is zero at nodes, but for hanging ones of degree 1, which lie beside the
          // surface.
          for (unsigned int k = 0; k < face.n_nodes(); ++k)
            for (unsigned int a = 0; a < 2; ++a)
              own_by_normal[m][k] +=
                (part.value_xi[a] * shapes.value[k] + part.value * shapes.gradient[k][a]) *
                by_tangents[a];
        }
  }



  FacePosition
  FaceDifferentiator::position(const std::array<double, 2> &xi) const
  {
    // Position alone: all that the slave side of a gap needs, as the normal is that of the master.
    const Face       &face = geometry.face();
    FacePosition      result{FaceShapes(face.degree, xi), geometry.evaluate(xi), {}, {}};
    const FaceShapes &shapes = result.shapes;
    if (patch)
      {
        // The point is linear in the control points, which depend on four positions and on four
        // nodal normals.
        const GregoryPatch::Basis basis(xi);
        for (unsigned int k = 0; k < GregoryPatch::n_control_points; ++k)
          for (unsigned int m = 0; m < 8; ++m)
            (m < 4 ? result.x_position : result.x_normal)[m % 4] += basis.value[k] * (*patch)[k][m];
        return result;
      }
    const auto part = geometry.following_part(shapes, xi);
    result.x_position =
      derivative_on_face(face, result.point.x, shapes.value, part.value * part.normal, turn.get());
    for (unsigned int m = 0; m < face.n_nodes() && geometry.follows_normals(); ++m)
      for (unsigned int d = 0; d < dim; ++d)
        result.x_normal[m][d][d] = part.value * shapes.value[m];
    return result;
  }



  void
  FaceDifferentiator::differentiate_tangents(FaceDerivative              &result,
                                             const std::array<double, 2> &xi) const
  {
    const FaceShapes &shapes = result.shapes;
    const Face       &face   = geometry.face();
    if (patch)
      {
        const GregoryPatch::Basis basis(xi);
        for (unsigned int k = 0; k < GregoryPatch::n_control_points; ++k)
          for (unsigned int m = 0; m < 8; ++m)
            for (unsigned int a = 0; a < 2; ++a)
              (m < 4 ? result.tangent_position : result.tangent_normal)[a][m % 4] +=
                basis.gradient[k][a] * (*patch)[k][m];
        return;
      }
    const auto part = geometry.following_part(shapes, xi);
    result.tangent_position =
      tangent_derivatives(face, shapes, result.point.tangents, turn.get(), part);
    for (unsigned int m = 0; m < face.n_nodes() && geometry.follows_normals(); ++m)
      for (unsigned int a = 0; a < 2; ++a)
        for (unsigned int d = 0; d < dim; ++d)
          result.tangent_normal[a][m][d][d] =
            part.value_xi[a] * shapes.value[m] + part.value * shapes.gradient[m][a];
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
            if (geometry.follows_normals())
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
        if (geometry.exact_surface())
          {
            result.normal_position[m] = direction * result.normal_position[m];
            for (unsigned int k = 0; k < n; ++k)
              result.normal_normal[m] -= shapes.value[k] * own_by_normal[k][m];
            result.normal_normal[m] = direction * result.normal_normal[m];
          }
        result.normal_normal[m] += shapes.value[m] * direction;
      }
  }



  FaceDerivative
  FaceDifferentiator::at(const std::array<double, 2> &xi) const
  {
    const FacePosition at_point = position(xi);
    FaceDerivative     result{at_point.shapes,
                          at_point.point,
                          {},
                          {},
                          {},
                          {},
                          at_point.x_position,
                          at_point.x_normal,
                          {},
                          {}};
    differentiate_tangents(result, xi);
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
} // namespace Touchstone
