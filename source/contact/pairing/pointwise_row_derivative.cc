// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/pointwise_row_derivative.h>
#include <touchstone/contact/pairing/row_derivative.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>

// Differentiates rows of points and faces for the consistent linearisation (doc/theory.md 4,
// equation (9)): those of slave nodes on master faces, and of master vertices in slave faces.
namespace Touchstone
{
  using namespace dealii;

  ClosestPointDerivative::ClosestPointDerivative(const FaceGeometry          &geometry,
                                                 const std::array<double, 2> &xi,
                                                 const FacePoint             &point,
                                                 const Tensor<1, dim>        &r)
  {
    // The matrix of equation (9), which is also the Hessian of the projection.
    const auto second = geometry.second_derivatives(xi);
    double     a[2][2];
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        a[i][j] = point.tangents[i] * point.tangents[j] - r * second[i + j];
    bool free[2];
    for (unsigned int i = 0; i < 2; ++i)
      {
        const double scale = point.tangents[i].norm_square();
        // Free in the interior, or at an edge if the node lies on the inner side of it.
        free[i] = std::abs(xi[i]) < 1. || xi[i] * (point.tangents[i] * r) <= 1e-12 * scale;
        // At a centre of curvature the closest point is not unique.
        free[i] = free[i] && a[i][i] > 1e-6 * scale;
      }
    const double det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    if (free[0] && free[1])
      {
        // Nearly singular: xi has no usable derivative and is taken as fixed.
        if (det < 1e-6 * a[0][0] * a[1][1])
          return;
        inverse[0][0] = a[1][1] / det;
        inverse[1][1] = a[0][0] / det;
        inverse[0][1] = inverse[1][0] = -a[0][1] / det;
      }
    else
      for (unsigned int i = 0; i < 2; ++i)
        if (free[i])
          inverse[i][i] = 1. / a[i][i];
  }



  PointwiseRowDerivative::PointwiseRowDerivative(const FaceGeometry   &geometry,
                                                 const ContactPartner &partner,
                                                 const FaceDerivative &master,
                                                 const Tensor<1, dim> &gap_vector)
    : geometry(geometry)
    , partner(partner)
    , r(gap_vector)
    , master(master)
    , closest(geometry, partner.xi, master.point, r)
    , by_slave(closest(master.point.tangents[0], master.point.tangents[1]))
    , by_gap_vector(partner.wedge * normalisation_derivative(r))
  {
  }



  void
  PointwiseRowDerivative::add(const Index                      node,
                              const Tensor<2, dim>            &gap_vector,
                              const Tensor<2, dim>            &normal,
                              const CoordinateDerivative      &xi,
                              const Tensor<2, dim>            *chain,
                              const std::vector<unsigned int> &local,
                              const double                     part,
                              RowDerivativeBuilder            &builder) const
  {
    Tensor<2, dim> d_gap = gap_vector, d_normal = normal;
    for (unsigned int a = 0; a < 2; ++a)
      {
        // Total change: at fixed xi, plus that of the contact point along the face.
        d_gap -= outer_product(master.point.tangents[a], xi[a]);
        d_normal += outer_product(master.normal_xi[a], xi[a]);
      }
    // In the wedge n = +-r/|r|, which depends on the gap vector alone.
    if (partner.wedge != 0)
      d_normal = by_gap_vector * d_gap;
    const unsigned int i = builder.index(node);
    d_gap *= part;
    d_normal *= part;
    builder.result->gap_vector[i] += chain ? d_gap * *chain : d_gap;
    builder.result->normal[i] += chain ? d_normal * *chain : d_normal;
    for (std::size_t m = 0; m < local.size(); ++m)
      if (local[m] < geometry.face().n_nodes())
        {
          const auto          &gradient = master.shapes.gradient[local[m]];
          const Tensor<1, dim> d_weight = part * (gradient[0] * xi[0] + gradient[1] * xi[1]);
          builder.result->weights[m][i] += chain ? d_weight * *chain : d_weight;
        }
  }



  void
  PointwiseRowDerivative::compute(const Index                          slave,
                                  const Stencil                       &stencil,
                                  const double                         part,
                                  const std::vector<NormalDerivative> *of_normals,
                                  RowDerivativeBuilder                &builder) const
  {
    const Face               &face = geometry.face();
    std::vector<unsigned int> local;
    // Nodes of other faces on whose edge the slave node lies are not on this one.
    for (const StencilEntry &entry : stencil)
      local.push_back(face.number_of(entry.node));
    const Tensor<2, dim> identity(unit_symmetric_tensor<dim>());
    // The slave node changes r directly and xi over the projection, not the normal at fixed xi.
    // Master nodes move the point and its tangents; nodes around them act over the averaged
    // normals.
    add(slave, identity, {}, by_slave, nullptr, local, part, builder);
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      add(face.nodes[m],
          -1. * master.x_position[m],
          master.normal_position[m],
          coordinates(master.x_position[m],
                      master.tangent_position[0][m],
                      master.tangent_position[1][m]),
          nullptr,
          local,
          part,
          builder);
    // Those of facets matter beside their edges only, see normal_over_edges().
    const bool by_normals =
      geometry.follows_normals() ||
      (partner.wedge == 0 &&
       std::any_of(master.normal_normal.begin(),
                   master.normal_normal.begin() + face.n_nodes(),
                   [](const Tensor<2, dim> &by_normal) { return by_normal.norm_square() > 0.; }));
    if (of_normals && by_normals)
      for (const NormalDerivative &d : *of_normals)
        add(d.node,
            -1. * master.x_normal[d.m],
            master.normal_normal[d.m],
            coordinates(master.x_normal[d.m],
                        master.tangent_normal[0][d.m],
                        master.tangent_normal[1][d.m]),
            &d.value,
            local,
            part,
            builder);
  }
} // namespace Touchstone
