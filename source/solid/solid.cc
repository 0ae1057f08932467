// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/base/non_convergence.h>
#include <touchstone/solid/linear_cells.h>
#include <touchstone/solid/solid.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <cmath>
#include <limits>

// The discretised bodies: dofs, hanging nodes, the stiffness matrix over all of them, internal
// forces, energies, stresses and history. Linear bodies contribute K u with a matrix assembled
// once; the rows of nonlinear bodies are assembled and evaluated anew by NonlinearCells.
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
    Vector result(owned, relevant, communicator);
    result = u;
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
    assemble(Vector(owned, communicator));
  }



  /** Turn the failure of a material law on any rank into an exception on all of them; it cuts the
   * step. Laws without history cannot fail, so elastic runs are spared the reduction. */
  void
  Solid::check_solved(const bool solved) const
  {
    if (has_history() && Utilities::MPI::min(solved ? 1 : 0, communicator) == 0)
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



  /** The product writes the forces of linear bodies and, for the others, numbers without meaning
   * (tangent times u), which the loop over nonlinear cells replaces. */
  void
  Solid::internal_force(const Vector &u, Vector &force) const
  {
    stiffness().vmult(force, u);
    if (!linear())
      check_solved(nonlinear->internal_force(ghosted(u), force));
  }



  /** Elastic energy: u.Ku / 2 over the rows of linear bodies, and the integrals over the cells of
   * the others. Rows of nonlinear bodies are set to zero first, so that the product counts linear
   * bodies alone. Collective. */
  double
  Solid::strain_energy(const Vector &u) const
  {
    Vector force(u);
    stiffness().vmult(force, u);
    for (const int row : nonlinear->rows_of_nodes())
      std::fill(force.begin() + row, force.begin() + row + dim, 0.);
    const double of_linear = 0.5 * (force * u);
    return linear()
             ? of_linear
             : of_linear + Utilities::MPI::sum(nonlinear->elastic_energy(ghosted(u)), communicator);
  }



  /** Whether det F > 0 at all points of all ranks (doc/theory.md 2.2); always true for linear
   * bodies. Collective. */
  bool
  Solid::admissible(const Vector &u) const
  {
    if (linear())
      return true;
    matrix_to_fill(); // with it come the arrays of the cells
    return Utilities::MPI::min(nonlinear->smallest_determinant(ghosted(u)), communicator) > 0.;
  }



  /** An estimate of the round-off in the norm of the internal forces (force): the machine
   * precision times the sums of absolute values that cancel in them. A residual below it cannot
   * be expected of Newton's method. Collective. */
  double
  Solid::round_off(const Vector &u) const
  {
    // Of linear bodies K u, of the others also F = I + grad u, whose entries are
    // known no better than those of I.
    double sum = 0.;
    for (std::size_t i = 0; i < row_sums.size(); ++i)
      {
        const double length = linear() ? 0. : nonlinear->round_off_length()[i];
        sum += std::pow(row_sums[i] * (std::abs(u.begin()[i]) + length), 2);
      }
    return std::numeric_limits<double>::epsilon() *
           std::sqrt(Utilities::MPI::sum(sum, communicator));
  }



  void
  Solid::for_each_stress(
    const Vector &u,
    const std::function<
      void(unsigned int, const Point<dim> &, const SymmetricTensor<2, dim> &, double)> &visit) const
  {
    // One kernel per linear body, made once: it evaluates shapes and tables that all cells of the
    // body share.
    std::vector<std::unique_ptr<ElementKernel>> kernels;
    for (const BodyParameters &body : bodies)
      kernels.push_back(
        body.material.linear()
          ? std::make_unique<ElementKernel>(mapping, fe, body.element(), body.material)
          : nullptr);
    std::vector<Index>  dofs(fe.n_dofs_per_cell());
    std::vector<double> values(fe.n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          if (CellKernel *kernel = nonlinear->at(cell, u))
            {
              for (unsigned int q = 0; q < kernel->n_quadrature_points(); ++q)
                visit(cell->material_id(), kernel->point(q), kernel->stress(q), kernel->volume(q));
              continue;
            }
          ElementKernel &kernel = *kernels[cell->material_id()];
          cell->get_dof_indices(dofs);
          for (unsigned int a = 0; a < kernel.nodes_per_cell(); ++a)
            for (unsigned int d = 0; d < dim; ++d)
              values[dim * a + d] = u(dofs[kernel.local_dof(a, d)]);
          kernel.reinit(cell);
          kernel.set_displacement(values);
          for (unsigned int q = 0; q < kernel.n_quadrature_points(); ++q)
            visit(cell->material_id(), kernel.point(q), kernel.stress(q), kernel.volume(q));
        }
  }



  /** Mean stress of each cell for output, with equal weights of its points; for_each_stress()
   * visits the points of a cell one after the other, so the counter tells the cell. */
  std::vector<SymmetricTensor<2, dim>>
  Solid::cell_stress(const Vector &u) const
  {
    std::vector<SymmetricTensor<2, dim>> result;
    std::vector<unsigned int>            cells;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        cells.push_back(cell->active_cell_index());
    result.resize(dof_handler.get_triangulation().n_active_cells());
    const unsigned int n_points = Utilities::pow(fe.degree + 1, dim);
    unsigned int       counter  = 0;
    for_each_stress(u,
                    [&](const unsigned int,
                        const Point<dim> &,
                        const SymmetricTensor<2, dim> &stress,
                        const double) {
                      result[cells[counter++ / n_points]] += stress / n_points;
                    });
    return result;
  }



  /** Ranks assemble their ghost cells as well, so history of a cell must be known to all of these.
   * Collective. */
  void
  Solid::save(ArchiveWriter &archive) const
  {
    if (has_history())
      archive.put_cells("material", [this](const unsigned int cell) { return cell_state(cell); });
  }



  void
  Solid::load(const ArchiveReader &archive)
  {
    if (!has_history())
      return;
    const auto &states = archive.cells("material");
    for (unsigned int cell = 0; cell < states.size(); ++cell)
      if (!states[cell].empty())
        set_cell_state(cell, states[cell]);
    // Ghost cells need the history of their owners.
    exchange_cell_states();
  }



  void
  Solid::exchange_cell_states()
  {
    using Cell = Triangulation<dim>::active_cell_iterator;
    if (has_history())
      GridTools::exchange_cell_data_to_ghosts<std::vector<double>, Triangulation<dim>>(
        dof_handler.get_triangulation(),
        [&](const Cell &cell) -> std_cxx17::optional<std::vector<double>> {
          return cell_state(cell->active_cell_index());
        },
        [&](const Cell &cell, const std::vector<double> &values) {
          set_cell_state(cell->active_cell_index(), values);
        });
  }



  /** Plastic work since the start over all bodies (energy; doc/materials.md, "Output").
   * Collective. */
  double
  Solid::dissipation() const
  {
    double sum = 0.;
    if (!has_history())
      return sum;
    nonlinear->for_each_state(
      [&](const unsigned int body, unsigned int, const double volume, const double *state) {
        sum += volume * history_law(body)->dissipation(state);
      });
    return Utilities::MPI::sum(sum, communicator);
  }



  dealii::Vector<double>
  Solid::cell_plastic_strain() const
  {
    // Means over the reference volumes of the points of each cell.
    const unsigned int     n = dof_handler.get_triangulation().n_active_cells();
    dealii::Vector<double> result(n), volumes(n);
    if (plastic())
      nonlinear->for_each_state([&](const unsigned int body,
                                    const unsigned int cell,
                                    const double       volume,
                                    const double      *state) {
        result(cell) += volume * history_law(body)->plastic_strain(state);
        volumes(cell) += volume;
      });
    for (unsigned int i = 0; i < n; ++i)
      if (volumes(i) > 0.)
        result(i) /= volumes(i);
    return result;
  }



  std::map<unsigned int, double>
  Solid::largest_plastic_strain() const
  {
    // Plastic bodies get an entry on all ranks, also those that own none of their cells: the
    // reduction below is collective for each entry.
    std::map<unsigned int, double> result;
    for (unsigned int b = 0; b < bodies.size(); ++b)
      if (const auto law = history_law(b); law && law->plastic())
        result[b] = 0.;
    if (plastic())
      nonlinear->for_each_state(
        [&](const unsigned int body, unsigned int, double, const double *state) {
          if (const auto found = result.find(body); found != result.end())
            found->second = std::max(found->second, history_law(body)->plastic_strain(state));
        });
    for (auto &[body, value] : result)
      value = Utilities::MPI::max(value, communicator);
    return result;
  }
} // namespace Touchstone
