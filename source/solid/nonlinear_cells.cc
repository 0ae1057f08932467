// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/finite_strain_kernel.h>
#include <touchstone/solid/nonlinear_cells.h>
#include <touchstone/solid/small_strain_kernel.h>

#include <deal.II/fe/fe_q.h>

#include <algorithm>
#include <limits>

// Cells of bodies with a nonlinear law: their nodes, positions and history in contiguous arrays,
// and the loops over them for forces, tangent and energies. Linear bodies are not here, as their
// stiffness is assembled once (doc/theory.md 2.1). The rows of both kinds in the one stiffness
// matrix are disjoint, for bodies share no nodes: so rows of nonlinear bodies can be cleared and
// assembled anew while the others stay.
namespace Touchstone
{
  using namespace dealii;

  NonlinearCells::NonlinearCells(const std::vector<BodyParameters> &bodies, const FESystem<dim> &fe)
    : n_nodes(fe.n_dofs_per_cell() / dim)
    , kernels(bodies.size())
    , unit_points(FE_Q<dim>(fe.degree).get_unit_support_points())
    , position(fe.n_dofs_per_cell())
    , displacement(fe.n_dofs_per_cell())
  {
    for (unsigned int b = 0; b < bodies.size(); ++b)
      if (const BodyParameters &body = bodies[b]; !body.material.linear())
        {
          if (body.material.finite_strain())
            kernels[b] =
              std::make_unique<FiniteStrainKernel>(fe.degree, body.element(), body.material);
          else
            kernels[b] =
              std::make_unique<SmallStrainKernel>(fe.degree, body.element(), body.material);
          any_body      = true;
          any_history   = any_history || kernels[b]->n_state() > 0;
          any_failure   = any_failure || kernels[b]->material()->can_fail();
          any_plastic   = any_plastic || kernels[b]->material()->plastic();
          all_symmetric = all_symmetric && kernels[b]->material()->symmetric();
        }
  }



  /** Collect the cells of nonlinear bodies on a new mesh, with virgin history. All owned cells are
   * needed, for energies and history, and of the ghost cells those with a row of this rank: these
   * are assembled here as well, so that forces and stiffness need no communication. */
  void
  NonlinearCells::reinit(const MappingQ<dim> &new_mapping, const DoFHandler<dim> &new_dof_handler)
  {
    mapping     = &new_mapping;
    dof_handler = &new_dof_handler;
    if (!any_body)
      return;
    const IndexSet    &owned = dof_handler->locally_owned_dofs();
    std::vector<Index> cell_dofs(dof_handler->get_fe().n_dofs_per_cell());
    number.assign(dof_handler->get_triangulation().n_active_cells(), -1);
    for (const auto &cell : dof_handler->active_cell_iterators())
      if (!cell->is_artificial() && kernels[cell->material_id()])
        {
          bool any = cell->is_locally_owned();
          if (!any)
            {
              cell->get_dof_indices(cell_dofs);
              for (const Index dof : cell_dofs)
                any = any || owned.is_element(dof);
            }
          if (!any)
            continue;
          number[cell->active_cell_index()] = cells.size();
          cells.push_back(
            {cell->material_id(), cell->is_locally_owned(), cell->active_cell_index(), n_history});
          n_history += kernels[cell->material_id()]->n_state();
        }
  }



  void
  NonlinearCells::connect(const Matrix &stiffness)
  {
    if (!any_body)
      return;
    const FiniteElement<dim> &fe = dof_handler->get_fe();
    std::vector<Index>        cell_dofs(fe.n_dofs_per_cell());
    std::vector<char>         known(dim * stiffness.n_nodes());
    size.assign(known.size(), 0.);
    for (const auto &cell : dof_handler->active_cell_iterators())
      if (!cell->is_artificial() && number[cell->active_cell_index()] >= 0)
        {
          cell->get_dof_indices(cell_dofs);
          const CellKernel &kernel = *kernels[cell->material_id()];
          set_position(cell);
          positions.insert(positions.end(), position.begin(), position.end());
          // Only nodes of cells that have a row of this rank are known to the matrix; nothing is
          // added for others.
          bool any = false;
          for (unsigned int a = 0; a < n_nodes; ++a)
            any = any || stiffness.row(cell_dofs[fe.component_to_system_index(0, a)]) >= 0;
          for (unsigned int a = 0; a < n_nodes; ++a)
            {
              const Index first = cell_dofs[fe.component_to_system_index(0, a)];
              const int   row   = stiffness.row(first);
              dofs.push_back(first);
              rows.push_back(row);
              nodes.push_back(any ? stiffness.node(first) : numbers::invalid_unsigned_int);
              if (row < 0)
                continue;
              if (!known[row])
                node_rows.push_back(row);
              known[row] = 1;
              // The length scale of round_off_length(): at finite strain F = I + grad u is known
              // to the round-off of its unit part, which counts like that of a displacement of
              // the size of the cell.
              if (kernel.finite_strain())
                for (unsigned int d = 0; d < dim; ++d)
                  size[row + d] = std::max(size[row + d], cell->diameter() / fe.degree);
            }
        }
    need_history();
  }



  void
  NonlinearCells::need_history() const
  {
    if (elsewhere != nullptr || committed.size() == n_history)
      return;
    committed.resize(n_history);
    for (const Cell &cell : cells)
      kernels[cell.body]->start(committed.data() + cell.state);
    present = committed;
  }



  void
  NonlinearCells::keep_in(CellHistory *const other)
  {
    elsewhere = other;
    for (std::vector<double> *values : {&committed, &present})
      std::vector<double>().swap(*values);
  }



  void
  NonlinearCells::set_position(const DoFHandler<dim>::active_cell_iterator &cell) const
  {
    for (unsigned int a = 0; a < n_nodes; ++a)
      {
        const Point<dim> x = mapping->transform_unit_to_real_cell(cell, unit_points[a]);
        for (unsigned int d = 0; d < dim; ++d)
          position[dim * a + d] = x[d];
      }
  }



  void
  NonlinearCells::set_time(const double time)
  {
    for (const auto &kernel : kernels)
      if (kernel)
        kernel->set_time(time);
  }



  void
  NonlinearCells::set_step_length(const double length)
  {
    for (const auto &kernel : kernels)
      if (kernel)
        kernel->set_step_length(length);
  }



  /** Set the kernel of the body of cell @p c to this cell and displacement @p u. A body has one
   * kernel for all its cells, so the reference is valid until the next call. */
  CellKernel &
  NonlinearCells::go_to(const std::size_t c, const Vector &u, double &determinant)
  {
    // Owned dofs follow one another in the layout with ghosts, too: one look-up in its hash table
    // finds all of the cell.
    const Epetra_BlockMap &layout  = u.trilinos_partitioner();
    const Index *const     of_cell = &dofs[c * n_nodes];
    const int *const       row     = &rows[c * n_nodes];
    const auto             local   = [&](const unsigned int a) {
      return layout.LID(static_cast<int>(of_cell[a]));
    };
    const unsigned int owned =
      std::find_if(row, row + n_nodes, [](const int r) { return r >= 0; }) - row;
    const int first = owned < n_nodes ? local(owned) - row[owned] : 0;
    for (unsigned int a = 0; a < n_nodes; ++a)
      std::copy_n(u.begin() + (row[a] >= 0 ? first + row[a] : local(a)),
                  dim,
                  displacement.data() + dim * a);
    CellKernel &kernel = *kernels[cells[c].body];
    determinant        = kernel.reinit(&positions[c * dim * n_nodes],
                                displacement.data(),
                                committed.data() + cells[c].state);
    return kernel;
  }



  /** Add the tangent of all cells at @p u to the stiffness matrix, whose rows of these bodies are
   * cleared before. Returns false if the law of any point on this rank failed; the loop goes on
   * nevertheless, for the caller must learn of it on all ranks together. */
  bool
  NonlinearCells::assemble(const Vector &u, const bool symmetric_part, Matrix &stiffness)
  {
    for (const int row : node_rows)
      stiffness.clear_node(row);
    double determinant;
    bool   solved = true;
    for (std::size_t c = 0; c < cells.size(); ++c)
      {
        CellKernel   &kernel  = go_to(c, u, determinant);
        const double *of_cell = kernel.stiffness(symmetric_part).data();
        stiffness.add(n_nodes,
                      &rows[c * n_nodes],
                      &nodes[c * n_nodes],
                      [&](const unsigned int i, const unsigned int j) {
                        return of_cell[dim * n_nodes * i + j];
                      });
        solved = solved && kernel.solved();
      }
    return solved;
  }



  /** Replace the entries of these bodies in @p force, which the product with the stiffness matrix
   * has filled with K u, by the internal forces. This alone sets the present state of history, by
   * which a step is committed (doc/materials.md, "State"): the last residual of a step is that of
   * its solution. */
  bool
  NonlinearCells::internal_force(const Vector &u, Vector &force)
  {
    double *values = force.begin();
    for (const int row : node_rows)
      std::fill(values + row, values + row + dim, 0.);
    double determinant;
    bool   solved = true;
    for (std::size_t c = 0; c < cells.size(); ++c)
      {
        CellKernel                &kernel = go_to(c, u, determinant);
        const std::vector<double> &forces = kernel.force();
        for (unsigned int a = 0; a < n_nodes; ++a)
          if (const int row = rows[c * n_nodes + a]; row >= 0)
            for (unsigned int d = 0; d < dim; ++d)
              values[row + d] += forces[dim * a + d];
        std::copy(kernel.present().begin(),
                  kernel.present().end(),
                  present.begin() + cells[c].state);
        solved = solved && kernel.solved();
      }
    return solved;
  }



  /** Stored energy of the cells of this rank (energy); ghost cells are left out, as the caller
   * sums over all ranks. */
  double
  NonlinearCells::elastic_energy(const Vector &u)
  {
    double sum = 0., determinant;
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (cells[c].owned)
        sum += go_to(c, u, determinant).elastic_energy();
    return sum;
  }



  /** Smallest det F at the quadrature points of this rank, by which Newton's method shortens
   * increments that would invert a cell (doc/theory.md 2.2). */
  double
  NonlinearCells::smallest_determinant(const Vector &u)
  {
    double smallest = std::numeric_limits<double>::max(), determinant;
    for (std::size_t c = 0; c < cells.size(); ++c)
      if (cells[c].owned && kernels[cells[c].body]->can_invert())
        {
          go_to(c, u, determinant);
          smallest = std::min(smallest, determinant);
        }
    return smallest;
  }



  CellKernel *
  NonlinearCells::at(const DoFHandler<dim>::active_cell_iterator &cell, const Vector &u)
  {
    if (empty() || number[cell->active_cell_index()] < 0)
      return nullptr;
    const FiniteElement<dim> &fe = dof_handler->get_fe();
    std::vector<Index>        cell_dofs(fe.n_dofs_per_cell());
    cell->get_dof_indices(cell_dofs);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int d = 0; d < dim; ++d)
        displacement[dim * a + d] = u(cell_dofs[fe.component_to_system_index(0, a)] + d);
    set_position(cell);
    CellKernel &kernel = *kernels[cell->material_id()];
    // The kernel reads it as long as it is at this cell.
    kernel_state = state(cell->active_cell_index());
    kernel.reinit(position.data(), displacement.data(), kernel_state.data());
    return &kernel;
  }



  std::vector<double>
  NonlinearCells::state(const unsigned int cell) const
  {
    if (empty() || number[cell] < 0)
      return {};
    const Cell &data = cells[number[cell]];
    if (kernels[data.body]->n_state() == 0)
      return {};
    if (elsewhere != nullptr)
      return elsewhere->committed_state(cell);
    need_history();
    const auto begin = committed.begin() + data.state;
    return std::vector<double>(begin, begin + kernels[data.body]->n_state());
  }



  /** Set committed and present state of a cell, on a new mesh or from a checkpoint. Values for
   * cells that this rank does not keep are ignored: exchange between ghosts sends those, too. */
  void
  NonlinearCells::set_state(const unsigned int cell, const std::vector<double> &values)
  {
    const bool         known = !empty() && number[cell] >= 0;
    const unsigned int n     = known ? kernels[cells[number[cell]].body]->n_state() : 0;
    AssertThrow(values.size() == n || !known, ExcDimensionMismatch(values.size(), n));
    if (n == 0)
      return;
    if (elsewhere != nullptr)
      {
        elsewhere->set_state(cell, values);
        return;
      }
    need_history();
    const std::size_t begin = cells[number[cell]].state;
    std::copy(values.begin(), values.end(), committed.begin() + begin);
    std::copy(values.begin(), values.end(), present.begin() + begin);
  }



  std::shared_ptr<const MaterialLaw>
  NonlinearCells::law(const unsigned int body) const
  {
    return kernels[body] && kernels[body]->n_state() > 0 ? kernels[body]->material() : nullptr;
  }



  /** Visit the present state of all points of this rank. Only the reference volumes of the points
   * are needed of the kernel, so it is set to zero displacement. */
  void
  NonlinearCells::for_each_state(
    const std::function<void(unsigned int, unsigned int, double, const double *)> &visit) const
  {
    std::fill(displacement.begin(), displacement.end(), 0.);
    need_history();
    for (const auto &cell : dof_handler->active_cell_iterators())
      if (cell->is_locally_owned() && law(cell->material_id()))
        {
          CellKernel               &kernel  = *kernels[cell->material_id()];
          const unsigned int        n_state = kernel.material()->n_state();
          const std::vector<double> kept    = elsewhere
                                                ? elsewhere->committed_state(cell->active_cell_index())
                                                : std::vector<double>();
          const double *const       states =
            elsewhere ? kept.data()
                            : present.data() + cells[number[cell->active_cell_index()]].state;
          set_position(cell);
          kernel.reinit(position.data(), displacement.data());
          for (unsigned int q = 0; q < kernel.n_quadrature_points(); ++q)
            visit(cell->material_id(),
                  cell->active_cell_index(),
                  kernel.weight(q),
                  states + q * n_state);
        }
  }
} // namespace Touchstone
