// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/non_convergence.h>
#include <touchstone/solid/linear_cells.h>
#include <touchstone/solid/solid.h>
#include <touchstone/solid/thermal_strain.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>

// The discretised bodies: dofs, hanging nodes and the stiffness matrix over all of them. Linear
// bodies contribute a matrix assembled once; the rows of nonlinear bodies are assembled anew by
// NonlinearCells. Forces and stresses are in solid_forces.cc, history is in solid_history.cc.
// Conditions of supports and contact are applied elsewhere (doc/theory.md, section 7).
namespace Touchstone
{
  using namespace dealii;

  Solid::Solid(const std::vector<BodyParameters> &bodies,
               const unsigned int                 degree,
               const Forest                      &forest,
               const MPI_Comm                     communicator)
    : bodies(bodies)
    , fe(FE_Q<dim>(degree), dim)
    , mapping(degree)
    , dof_handler(forest.triangulation)
    , communicator(communicator)
  {
    reinit();
  }



  /** Distribute dofs and allocate all that depends on the mesh, at the start and after each
   * refinement. Collective. */
  void
  Solid::reinit()
  {
    nonlinear.reset();
    matrix.reset();
    dof_handler.distribute_dofs(fe);
    owned = dof_handler.locally_owned_dofs();
    DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
    zero.reinit(owned, communicator);
    // One rank has all values, and a map with a list of them is as large as half of the vector.
    if (Utilities::MPI::n_mpi_processes(communicator) > 1)
      {
        zero_with_ghosts.reinit(owned, relevant, communicator);
        import_ghosts.emplace(zero, zero_with_ghosts);
      }
    hanging.reinit(relevant);
    DoFTools::make_hanging_node_constraints(dof_handler, hanging);
    hanging.close();
    // Whether there are hanging nodes must be known to all ranks alike, as condense() is
    // collective.
    any_hanging = Utilities::MPI::max(hanging.n_constraints(), communicator) > 0;

    // Contact counts nodes, not dofs: node k has the dofs 3k, 3k+1, 3k+2.
    std::vector<Index> dofs(fe.n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            AssertThrow(dofs[i] % dim == fe.system_to_component_index(i).first,
                        ExcMessage("The unknowns are not numbered by nodes."));
        }

    nonlinear = std::make_unique<NonlinearCells>(bodies, fe);
    nonlinear->reinit(mapping, dof_handler);
    set_time(time);
  }



  /** The stiffness, zero and with the couplings of this mesh when it is asked for for the first
   * time. Collective. */
  Matrix &
  Solid::matrix_to_fill() const
  {
    if (matrix)
      return *matrix;
    // Rows are built from owned and ghost cells, so that no communication is needed.
    const Index n_nodes = dof_handler.n_dofs() / dim;
    IndexSet    owned_nodes(n_nodes);
    if (!owned.is_empty())
      owned_nodes.add_range(owned.nth_index_in_set(0) / dim,
                            owned.nth_index_in_set(owned.n_elements() - 1) / dim + 1);
    DynamicSparsityPattern couplings(n_nodes, n_nodes, owned_nodes);
    std::vector<Index>     dofs(fe.n_dofs_per_cell()), nodes(dofs.size() / dim);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell->get_dof_indices(dofs);
          std::sort(dofs.begin(), dofs.end());
          for (unsigned int a = 0; a < nodes.size(); ++a)
            nodes[a] = dofs[dim * a] / dim;
          for (const Index row : nodes)
            if (owned_nodes.is_element(row))
              couplings.add_entries(row, nodes.begin(), nodes.end(), true);
        }
    // It stores one of two transposed blocks where the tangent is symmetric, which the laws tell.
    matrix = std::make_unique<Matrix>();
    matrix->reinit(owned, couplings, communicator, symmetric());
    nonlinear->connect(*matrix);
    return *matrix;
  }



  /** Move the forces on hanging nodes to the nodes that they follow, f_p += C_hp f_h, and leave
   * zero (doc/theory.md, section 11, "Hanging nodes"). A parent can belong to another rank, which
   * the compress() covers. Collective. */
  void
  Solid::condense(Vector &force) const
  {
    if (!any_hanging)
      return;
    std::vector<Index>  unknowns;
    std::vector<double> values;
    for (const auto &line : hanging.get_lines())
      if (owned.is_element(line.index))
        {
          for (const auto &[parent, weight] : line.entries)
            {
              unknowns.push_back(parent);
              values.push_back(weight * force(line.index));
            }
          unknowns.push_back(line.index);
          values.push_back(-force(line.index));
        }
    force.add(unknowns, values);
    force.compress(VectorOperation::add);
    hanging.set_zero(force);
  }



  Vector
  Solid::ghosted(const Vector &u) const
  {
    if (!import_ghosts)
      return u;
    Vector result;
    result.reinit(zero_with_ghosts, /*omit_zeroing_entries=*/true);
    (*import_ghosts)(u, result);
    return result;
  }



  /** Assemble the stiffness of the linear bodies, once per mesh, and the tangent of the others at
   * rest. */
  void
  Solid::assemble()
  {
    Matrix &stiffness = matrix_to_fill();
    stiffness         = 0.;
    std::vector<std::unique_ptr<LinearCells>> linear_cells;
    for (const BodyParameters &body : bodies)
      linear_cells.push_back(
        body.material.linear() ? std::make_unique<LinearCells>(mapping, fe, body) : nullptr);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial() && linear_cells[cell->material_id()])
        linear_cells[cell->material_id()]->add(cell, stiffness);
    for (const auto &cells : linear_cells)
      if (cells)
        cells->finish(stiffness);
    assemble(zero);
  }



  /** Turn the failure of a material law on any rank into an exception on all of them; it cuts the
   * step. Most laws without history cannot fail, so elastic runs are spared the reduction. */
  void
  Solid::check_solved(const bool solved) const
  {
    if (!nonlinear->can_fail() || Utilities::MPI::min(solved ? 1 : 0, communicator) == 1)
      return;
    check_temperatures(*this, time);
    throw MaterialFailure(plastic() ? "the plastic strain of some point could not be found"
                                    : "a material law has no answer at some point");
  }



  void
  Solid::assemble(const Vector &u, const bool symmetric_part)
  {
    Matrix &stiffness = matrix_to_fill();
    if (!linear())
      check_solved(nonlinear->assemble(ghosted(u), symmetric_part, stiffness));
    row_sums = stiffness.absolute_row_sums();
  }
} // namespace Touchstone
