// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/element_kernel.h>
#include <touchstone/solid/solid.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

// Internal forces, energy and stresses of the bodies in a state: products with the stiffness for
// linear ones, and loops over the cells of the others (doc/theory.md 2).
namespace Touchstone
{
  using namespace dealii;

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
} // namespace Touchstone
