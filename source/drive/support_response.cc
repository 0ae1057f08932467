// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/step_problem.h>

#include <algorithm>

namespace Touchstone
{
  using namespace dealii;

  // The linear system of a Newton iteration answers what the bodies do if supports move: in the
  // converged state its right-hand side vanishes but for that motion. All enforcements can give it.
  std::optional<Vector>
  StepProblem::support_response(const std::vector<bool> &bodies, const Tensor<1, dim> &direction)
  {
    // Bolts that forces draw would have to give way.
    if (!solid.linear() || integration->dynamic() || pretension.by_force())
      return std::nullopt;
    // About as far as the bodies have moved, so that what is left of the residual is small beside
    // it.
    const double       distance = std::max(u.linfty_norm(), 1e-12 * extent);
    Vector             behind(u);
    std::vector<Index> dofs(solid.fe.n_dofs_per_cell());
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && bodies[cell->material_id()])
        {
          cell->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (solid.owned.is_element(dofs[i]))
              behind(dofs[i]) =
                u(dofs[i]) - distance * direction[solid.fe.system_to_component_index(i).first];
        }
    behind.compress(VectorOperation::insert);
    // The supports find the bodies that far behind, and take them along, and so does the ground.
    system->prescribe(time, behind);
    Vector moved(behind), forces(applied);
    moved -= u;
    boundary_conditions.ground_springs().add_force(moved, forces);
    // Newton's iterations would mend a solution that is less accurate, but here there is one: with
    // 1e-4 the estimate depended on the number of ranks by 1e-3.
    system->assemble({time,
                      u,
                      forces,
                      unbalanced,
                      relative_residual,
                      scene.linear_solver.tolerance,
                      forcing_term.slow(),
                      springs});
    Vector response(solid.zero_vector());
    system->solve(response);
    // As residual() has left them.
    system->prescribe(time, u);
    response *= 1. / distance;
    return response;
  }
} // namespace Touchstone
