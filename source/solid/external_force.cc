// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/boundary_conditions.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>

#include <array>
#include <vector>

// Nodal forces of tractions, pressures, body forces and forces on sets of nodes
// (doc/theory.md 2.1).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Zero for no function. */
    double
    evaluate(const std::shared_ptr<const Formula> &function, const Point<dim> &x, const double t)
    {
      return function ? function->value(x, t) : 0.;
    }
  } // namespace



  /** Consistent nodal forces of all loads at time t (force), integrated over the reference state.
   * Of u depend the follower pressure, springs, and moments on bodies at finite strain. Collective.
   */
  void
  BoundaryConditions::external_force(const double t, const Vector &u, Vector &force) const
  {
    force = 0.;
    following.add_force(t, u, force);
    springs.add_force(u, force);
    add_body_forces(t, force);
    add_tractions(t, u, force);
    add_set_forces(t, force);
    formulas.check(solid.communicator);
  }



  /** f_i = int N_i (traction - p n) dA over the reference surface. Ranks integrate ghost cells as
   * well and keep what belongs to their own dofs, so that nothing need be sent. The quadrature
   * has one point per direction more than the element needs, as tractions are arbitrary functions
   * of position. */
  void
  BoundaryConditions::add_tractions(const double t, const Vector &u, Vector &force) const
  {
    if (loads.empty())
      return;
    // Where the boundaries of forces and moments are that follow them.
    Vector                            ghosted;
    std::vector<ResultantLoad::Place> places(loads.size());
    for (std::size_t k = 0; k < loads.size(); ++k)
      if (const auto &resultant = loads[k].resultant)
        {
          if (resultant->follows() && ghosted.size() == 0)
            ghosted = solid.ghosted(u);
          places[k] = resultant->follows() ? resultant->place(ghosted) : resultant->at_start();
        }
    const FEValuesExtractors::Vector displacement(0);
    FEFaceValues<dim>                values(solid.mapping,
                             solid.fe,
                             QGauss<dim - 1>(solid.fe.degree + 2),
                             update_values | update_normal_vectors | update_JxW_values |
                               update_quadrature_points);
    std::vector<Index>               dofs(solid.fe.n_dofs_per_cell());
    std::vector<Tensor<1, dim>>      moved(values.n_quadrature_points);
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        for (const unsigned int f : cell->face_indices())
          for (std::size_t k = 0; k < loads.size(); ++k)
            if (const Load &load = loads[k];
                cell->at_boundary(f) && load.boundary.count(cell->face(f)->boundary_id()) > 0)
              {
                values.reinit(cell, f);
                cell->get_dof_indices(dofs);
                if (load.resultant && load.resultant->follows())
                  values[displacement].get_function_values(ghosted, moved);
                for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
                  {
                    const Point<dim> x = values.quadrature_point(q);
                    Tensor<1, dim>   traction =
                      -evaluate(load.pressure, x, t) * values.normal_vector(q);
                    for (unsigned int d = 0; d < dim; ++d)
                      traction[d] += evaluate(load.traction[d], x, t);
                    if (load.resultant)
                      traction +=
                        load.resultant->traction(places[k],
                                                 load.resultant->follows() ? x + moved[q] : x,
                                                 t);
                    for (unsigned int i = 0; i < dofs.size(); ++i)
                      if (solid.owned.is_element(dofs[i]))
                        force(dofs[i]) += values.shape_value(i, q) *
                                          traction[solid.fe.system_to_component_index(i).first] *
                                          values.JxW(q);
                  }
              }
    force.compress(VectorOperation::add);
  }



  void
  BoundaryConditions::add_set_forces(const double t, Vector &force) const
  {
    if (set_loads.empty())
      return;
    for (const NodeSetLoad &load : set_loads)
      for (unsigned int d = 0; d < dim; ++d)
        if (load.force[d])
          for (const SetNode &node : load.nodes)
            force(dim * node.node + d) += node.share * load.force[d]->value(node.position, t);
    force.compress(VectorOperation::add);
  }



  /** f_i = int N_i b dV over the reference volume, b a force per reference volume; own dofs from
   * owned and ghost cells as for tractions. */
  void
  BoundaryConditions::add_body_forces(const double t, Vector &force) const
  {
    if (body_forces.empty())
      return;
    if (mass != nullptr)
      {
        add_forces_on_mass(t, force);
        return;
      }
    FEValues<dim>      values(solid.mapping,
                         solid.fe,
                         QGauss<dim>(solid.fe.degree + 1),
                         update_values | update_JxW_values | update_quadrature_points);
    std::vector<Index> dofs(solid.fe.n_dofs_per_cell());
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        {
          const std::array<Function, dim> &functions = body_forces[cell->material_id()];
          if (!functions[0] && !functions[1] && !functions[2])
            continue;
          values.reinit(cell);
          cell->get_dof_indices(dofs);
          for (const unsigned int q : values.quadrature_point_indices())
            for (unsigned int d = 0; d < dim; ++d)
              if (const double b = evaluate(functions[d], values.quadrature_point(q), t); b != 0.)
                for (unsigned int i = 0; i < dofs.size(); ++i)
                  if (solid.fe.system_to_component_index(i).first == d &&
                      solid.owned.is_element(dofs[i]))
                    force(dofs[i]) += values.shape_value(i, q) * b * values.JxW(q);
        }
    force.compress(VectorOperation::add);
  }



  /** f = M b / rho. Gravity accelerates all nodes alike then, and a body that falls is free of
   * stress; at a node without mass the weight would hang on its cells instead. Of the
   * mass with the densities that make up for what was moved, so that resultant and centre are
   * those of the body. */
  void
  BoundaryConditions::add_forces_on_mass(const double t, Vector &force) const
  {
    Vector                        acceleration(solid.zero_vector()), of_mass(acceleration);
    const std::vector<Point<dim>> unit = solid.fe.get_unit_support_points();
    std::vector<Index>            dofs(solid.fe.n_dofs_per_cell());
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const std::array<Function, dim> &functions = body_forces[cell->material_id()];
          if (!functions[0] && !functions[1] && !functions[2])
            continue;
          const double density = solid.bodies[cell->material_id()].material.density;
          cell->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (const auto &function = functions[solid.fe.system_to_component_index(i).first];
                function && solid.owned.is_element(dofs[i]))
              acceleration(dofs[i]) =
                function->value(solid.mapping.transform_unit_to_real_cell(cell, unit[i]), t) /
                density;
        }
    acceleration.compress(VectorOperation::insert);
    mass->multiply(acceleration, of_mass);
    force += of_mass;
  }
} // namespace Touchstone
