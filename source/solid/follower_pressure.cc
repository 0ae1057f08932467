// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/follower_pressure.h>

#include <deal.II/base/quadrature_lib.h>

// Pressure on the deformed surface of bodies at finite strain (doc/theory.md 2.3, equation (2)):
// nodal forces by Nanson's formula and their derivatives, as terms of rank one that are added to
// the system beside the stiffness matrix.
namespace Touchstone
{
  using namespace dealii;

  /** Visit all quadrature points of loaded faces with two tangents of the reference surface,
   * orthonormal, so that dA is the reference area, and the same tangents after the deformation, F
   * t_a. With ghosts each rank sees all faces of its own nodes and needs to send nothing; without
   * them each face is visited once over all ranks. */
  void
  FollowerPressure::for_each_point(const double                                     t,
                                   const Vector                                    &u,
                                   const bool                                       with_ghosts,
                                   const std::function<void(const FEFaceValues<dim> &,
                                                            unsigned int,
                                                            const std::vector<Index> &,
                                                            const SurfacePoint &)> &visit) const
  {
    const FEValuesExtractors::Vector displacement(0);
    // Exact on the faces of both degrees: a closed surface has no net force or moment.
    FEFaceValues<dim>           values(solid.mapping,
                             solid.fe,
                             QGauss<dim - 1>(2 * solid.fe.degree + 1),
                             update_values | update_gradients | update_normal_vectors |
                               update_JxW_values | update_quadrature_points);
    const Vector                ghosted = solid.ghosted(u);
    std::vector<Index>          dofs(solid.fe.n_dofs_per_cell());
    std::vector<Tensor<2, dim>> gradients(values.n_quadrature_points);
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() || (with_ghosts && cell->is_ghost()))
        for (const unsigned int f : cell->face_indices())
          for (const Load &load : loads)
            if (cell->at_boundary(f) && load.boundary.count(cell->face(f)->boundary_id()) > 0)
              {
                values.reinit(cell, f);
                cell->get_dof_indices(dofs);
                values[displacement].get_function_gradients(ghosted, gradients);
                for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
                  {
                    const Tensor<1, dim> n = values.normal_vector(q);
                    unsigned int         d = 0; // the axis farthest from the normal
                    for (unsigned int e = 1; e < dim; ++e)
                      if (std::abs(n[e]) < std::abs(n[d]))
                        d = e;
                    Tensor<1, dim> axis;
                    axis[d] = 1.;
                    SurfacePoint point;
                    point.pressure = load.pressure->value(values.quadrature_point(q), t);
                    point.t[0]     = cross_product_3d(axis, n);
                    point.t[0] /= point.t[0].norm();
                    point.t[1] = cross_product_3d(n, point.t[0]);
                    for (unsigned int a = 0; a < 2; ++a)
                      point.moved[a] = point.t[a] + gradients[q] * point.t[a];
                    visit(values, q, dofs, point);
                  }
              }
  }



  /** Add f_i = -int N_i p (F t_1 x F t_2) dA (force): the cross product is the present normal
   * times the ratio of present to reference area. Collective. */
  void
  FollowerPressure::add_force(const double t, const Vector &u, Vector &force) const
  {
    if (loads.empty())
      return;
    for_each_point(
      t,
      u,
      true,
      [&](const auto &values, const unsigned int q, const auto &dofs, const SurfacePoint &point) {
        const Tensor<1, dim> traction =
          -point.pressure * cross_product_3d(point.moved[0], point.moved[1]);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (solid.owned.is_element(dofs[i]))
            force(dofs[i]) += values.shape_value(i, q) *
                              traction[solid.fe.system_to_component_index(i).first] * values.JxW(q);
      });
    force.compress(VectorOperation::add);
  }



  /** Append -df_i/du_j. Each term is added by one rank only, as a term may have entries on several
   * ranks, so ghost faces are left out here. With @p symmetric each product l r^T is replaced by
   * half of l r^T + r l^T, the symmetric part, for solvers that need it. */
  void
  FollowerPressure::add_stiffness(const double              t,
                                  const Vector             &u,
                                  const bool                symmetric,
                                  std::vector<RankOneTerm> &terms) const
  {
    if (loads.empty())
      return;
    for_each_point(
      t,
      u,
      false,
      [&](const auto &values, const unsigned int q, const auto &dofs, const SurfacePoint &point) {
        // A term for each direction c of the force, p N_i da_c/du.
        std::array<RankOneTerm, dim> of_point;
        for (unsigned int j = 0; j < dofs.size(); ++j)
          {
            const unsigned int component = solid.fe.system_to_component_index(j).first;
            const double       force = point.pressure * values.shape_value(j, q) * values.JxW(q);
            if (force != 0.)
              of_point[component].left.emplace_back(dofs[j], force);
            // Shapes that vanish at the point can still have a slope there.
            const Tensor<1, dim> gradient = values.shape_grad(j, q);
            const double         slope[2] = {gradient * point.t[0], gradient * point.t[1]};
            if (std::abs(slope[0]) + std::abs(slope[1]) <= 1e-14 * gradient.norm())
              continue;
            Tensor<1, dim> e;
            e[component] = 1.;
            // d ((F t_1) x (F t_2)) / du_j
            const Tensor<1, dim> change = slope[0] * cross_product_3d(e, point.moved[1]) +
                                          slope[1] * cross_product_3d(point.moved[0], e);
            for (unsigned int c = 0; c < dim; ++c)
              if (change[c] != 0.)
                of_point[c].right.emplace_back(dofs[j], symmetric ? 0.5 * change[c] : change[c]);
          }
        for (RankOneTerm &term : of_point)
          {
            terms.push_back(term);
            if (symmetric)
              terms.push_back({std::move(term.right), std::move(term.left)});
          }
      });
  }
} // namespace Touchstone
