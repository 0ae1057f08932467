// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/ground_springs.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <set>

// Springs to the ground (doc/theory.md 2.3).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The normal and two tangents. */
    std::array<Tensor<1, dim>, dim>
    frame_of_normal(const Tensor<1, dim> &n)
    {
      unsigned int d = 0; // the axis farthest from the normal
      for (unsigned int e = 1; e < dim; ++e)
        if (std::abs(n[e]) < std::abs(n[d]))
          d = e;
      Tensor<1, dim> axis;
      axis[d]              = 1.;
      Tensor<1, dim> first = cross_product_3d(axis, n);
      first /= first.norm();
      return {{n, first, cross_product_3d(n, first)}};
    }
  } // namespace



  void
  GroundSprings::for_each_point(
    const bool                                                  with_ghosts,
    const std::function<void(const FEFaceValues<dim> &,
                             unsigned int,
                             const std::vector<Index> &,
                             const std::array<Tensor<1, dim>, dim> &,
                             const std::array<double, dim> &)> &visit) const
  {
    // Products of two shapes are integrated exactly on plane parallelograms.
    FEFaceValues<dim>  values(solid.mapping,
                             solid.fe,
                             QGauss<dim - 1>(solid.fe.degree + 1),
                             update_values | update_normal_vectors | update_JxW_values |
                               update_quadrature_points);
    std::vector<Index> dofs(solid.fe.n_dofs_per_cell());
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() || (with_ghosts && cell->is_ghost()))
        for (const unsigned int f : cell->face_indices())
          for (const Spring &spring : springs)
            if (cell->at_boundary(f) && spring.boundary.count(cell->face(f)->boundary_id()) > 0)
              {
                values.reinit(cell, f);
                cell->get_dof_indices(dofs);
                for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
                  visit(values,
                        q,
                        dofs,
                        frame_of_normal(values.normal_vector(q)),
                        {{spring.normal * values.JxW(q),
                          spring.tangential * values.JxW(q),
                          spring.tangential * values.JxW(q)}});
              }
  }



  void
  GroundSprings::add_force(const Vector &u, Vector &force) const
  {
    if (springs.empty())
      return;
    const Vector ghosted = solid.ghosted(u);
    for_each_point(true,
                   [&](const auto        &values,
                       const unsigned int q,
                       const auto        &dofs,
                       const auto        &directions,
                       const auto        &stiffness) {
                     const FiniteElement<dim> &fe = solid.fe;
                     Tensor<1, dim>            moved, traction;
                     for (unsigned int i = 0; i < dofs.size(); ++i)
                       moved[fe.system_to_component_index(i).first] +=
                         values.shape_value(i, q) * ghosted(dofs[i]);
                     for (unsigned int d = 0; d < dim; ++d)
                       traction -= stiffness[d] * (directions[d] * moved) * directions[d];
                     for (unsigned int i = 0; i < dofs.size(); ++i)
                       if (solid.owned.is_element(dofs[i]))
                         force(dofs[i]) += values.shape_value(i, q) *
                                           traction[fe.system_to_component_index(i).first];
                   });
    force.compress(VectorOperation::add);
  }



  void
  GroundSprings::add_stiffness(std::vector<RankOneTerm> &terms) const
  {
    // Each term by one rank only, as it may have entries on several.
    if (springs.empty())
      return;
    for_each_point(false,
                   [&](const auto        &values,
                       const unsigned int q,
                       const auto        &dofs,
                       const auto        &directions,
                       const auto        &stiffness) {
                     for (unsigned int d = 0; d < dim; ++d)
                       if (stiffness[d] > 0.)
                         {
                           RankOneTerm term;
                           for (unsigned int i = 0; i < dofs.size(); ++i)
                             if (const double share =
                                   values.shape_value(i, q) *
                                   directions[d][solid.fe.system_to_component_index(i).first];
                                 share != 0.)
                               {
                                 term.left.emplace_back(dofs[i], stiffness[d] * share);
                                 term.right.emplace_back(dofs[i], share);
                               }
                           terms.push_back(std::move(term));
                         }
                   });
  }



  std::vector<Condition>
  GroundSprings::conditions() const
  {
    std::vector<Condition> result;
    std::set<Index>        seen;
    if (springs.empty())
      return result;
    for_each_point(
      true,
      [&](const auto &values,
          const unsigned int,
          const auto &dofs,
          const auto &directions,
          const auto &stiffness) {
        const auto &cell = values.get_cell();
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (solid.fe.system_to_component_index(i).first == 0 && solid.owned.is_element(dofs[i]) &&
              solid.fe.has_support_on_face(i, values.get_face_number()) &&
              seen.insert(dofs[i]).second)
            for (unsigned int d = 0; d < dim; ++d)
              if (stiffness[d] > 0.)
                {
                  Condition condition;
                  condition.node      = dofs[i] / dim;
                  condition.direction = directions[d];
                  condition.body      = cell->material_id();
                  condition.position =
                    solid.mapping.transform_unit_to_real_cell(cell, solid.fe.unit_support_point(i));
                  result.push_back(condition);
                }
      });
    return result;
  }

} // namespace Touchstone
