// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/formula.h>
#include <touchstone/drive/dynamics.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

// The state in which implicit dynamics starts: displacement and velocity from the formulas of the
// bodies, acceleration from the balance of forces (doc/time_integration.md).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /**
     * Nodal values of three formulas per body, one for each component; an empty formula stands for
     * zero. Nodes at which two bodies meet are separate dofs, so each body sets only its own.
     */
    Vector
    interpolate(const Solid               &solid,
                const std::string         &key,
                std::array<std::string, 3> BodyParameters::*const formulas)
    {
      Formulas all;
      Vector   result(solid.zero_vector());
      // Interpolation at the support points of the element, which are the nodes.
      const std::vector<Point<dim>> unit = solid.fe.get_unit_support_points();
      std::vector<Index>            dofs(solid.fe.n_dofs_per_cell());
      for (unsigned int b = 0; b < solid.bodies.size(); ++b)
        for (unsigned int d = 0; d < dim; ++d)
          {
            const std::string &formula = (solid.bodies[b].*formulas)[d];
            if (formula.empty())
              continue;
            const auto function =
              all.add(solid.bodies[b].section(), key + std::string(1, "xyz"[d]), formula);
            for (const auto &cell : solid.dof_handler.active_cell_iterators())
              if (cell->is_locally_owned() && cell->material_id() == b)
                {
                  cell->get_dof_indices(dofs);
                  for (unsigned int i = 0; i < dofs.size(); ++i)
                    if (solid.fe.system_to_component_index(i).first == d &&
                        solid.owned.is_element(dofs[i]))
                      result(dofs[i]) =
                        function->value(solid.mapping.transform_unit_to_real_cell(cell, unit[i]),
                                        0.);
                }
          }
      // Collective: a formula that is not finite on one rank must stop all of them.
      all.check(solid.communicator);
      result.compress(VectorOperation::insert);
      // Hanging nodes follow the nodes of the larger cell; a formula evaluated there would tear the
      // interpolated field at the edge.
      solid.hanging.distribute(result);
      return result;
    }
  } // namespace



  Vector
  Dynamics::initial_displacement() const
  {
    return interpolate(solid, "Initial displacement ", &BodyParameters::initial_displacement);
  }



  // The next step does work with it, as with all forces at its beginning.
  Vector
  Dynamics::support_force(const Vector                        &others,
                          const std::function<void(Vector &)> &remove_support) const
  {
    Vector result(others), drag(v), rest(others);
    mass.multiply(a, result);
    damping_force(v, drag);
    result += drag;
    result -= others;
    solid.condense(result);
    rest = result;
    remove_support(rest);
    result -= rest;
    return result;
  }



  void
  Dynamics::start(const Vector &external, const Vector &internal, const Supports &supports)
  {
    v = interpolate(solid, "Initial velocity ", &BodyParameters::initial_velocity);
    supports.set_velocity(v);
    // Initial acceleration from M a = f_ext - f_int - C v. With the lumped mass this needs no
    // solve, and differs from that of the consistent mass by the order of the mesh size only.
    // Contact forces are left out: bodies that touch at time 0 do not press yet.
    Vector force(external), drag(v);
    force -= internal;
    damping_force(v, drag);
    force -= drag;
    // Hanging nodes leave their mass, as their forces, to the nodes that they follow.
    Vector mass_of_node(mass.of_nodes());
    solid.condense(mass_of_node);
    solid.condense(force);
    supports.remove_force(force);
    for (std::size_t i = 0; i < force.locally_owned_size(); ++i)
      a.begin()[i] = mass_of_node.begin()[i] > 0. ? force.begin()[i] / mass_of_node.begin()[i] : 0.;
    supports.set_acceleration(a);
    solid.hanging.distribute(a);
    force = external;
    force -= internal;
    old.support = support_force(force, supports.remove_force);
    // The ledger of energies begins here: the sum of kinetic and strain energy is what all later
    // steps are compared with.
    old.external = old.load = external;
    old.internal            = internal;
    committed.kinetic       = kinetic_energy(v);
    committed.strain        = solid.strain_energy(committed_u);
    committed.initial       = committed.present();
    committed.update_largest();
  }
} // namespace Touchstone
