// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/refinement.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>

#include <cmath>
#include <cstdint>
#include <limits>

// Which cells are refined and coarsened (doc/theory.md 11, "Marking"). Marks are exchanged with the
// ghost cells until nothing changes, so that the mesh does not depend on the partition.
namespace Touchstone
{
  using namespace dealii;

  double
  Refinement::bulk_threshold(const Values &values, const double fraction) const
  {
    const double total = Utilities::MPI::sum(values.l1_norm(), solid.communicator);
    double       low = 0., high = Utilities::MPI::max(values.linfty_norm(), solid.communicator);
    if (total <= 0. || fraction <= 0.)
      return std::numeric_limits<double>::max();
    // Doerfler's bulk criterion (doc/theory.md 11, "Marking"): the largest threshold such that the
    // values above it make up the given fraction of the sum. Sorting would need all values on one
    // rank; bisection needs one global sum per step, and all ranks take the same path. The interval
    // is halved in the logarithm, as errors span decades.
    const double smallest = 1e-16 * high;
    for (unsigned int step = 0; step < 60; ++step)
      {
        const double middle = low == 0. ? std::sqrt(smallest * high) : std::sqrt(low * high);
        double       sum    = 0.;
        for (const double value : values)
          if (value >= middle)
            sum += value;
        (Utilities::MPI::sum(sum, solid.communicator) >= fraction * total ? low : high) = middle;
      }
    // The threshold is lowered by 1e-4, so that cells which differ by round-off only are marked
    // alike: symmetric problems stay symmetric, and the number of ranks does not matter.
    return (1. - 1e-4) * low;
  }



  bool
  Refinement::share_marks()
  {
    enum : unsigned int
    {
      keep,
      refine,
      coarsen
    };
    using Cell = Triangulation<dim>::active_cell_iterator;
    // The mark of a ghost cell is decided by its owner; the local copy may differ.
    const auto pack = [](const Cell &cell) -> std_cxx17::optional<unsigned int> {
      return cell->refine_flag_set() ? refine : cell->coarsen_flag_set() ? coarsen : keep;
    };
    int changes = 0;
    GridTools::exchange_cell_data_to_ghosts<unsigned int>(
      forest.triangulation, pack, [&](const Cell &cell, const unsigned int mark) {
        if (mark == *pack(cell))
          return;
        changes = 1;
        cell->clear_refine_flag();
        cell->clear_coarsen_flag();
        if (mark == refine)
          cell->set_refine_flag();
        // Coarsening is a decision on all children of a parent. The owner knows all of them, while
        // here some may be artificial: the mark is therefore set for the whole family that is
        // active here. Those that are to be refined hear of it from their own owners.
        else if (mark == coarsen)
          for (unsigned int child = 0; child < cell->parent()->n_children(); ++child)
            if (const auto sibling = cell->parent()->child(child); sibling->is_active())
              {
                if (sibling->is_artificial())
                  sibling->clear_refine_flag();
                if (!sibling->refine_flag_set())
                  sibling->set_coarsen_flag();
              }
      });
    return Utilities::MPI::max(changes, solid.communicator) == 1;
  }



  void
  Refinement::settle_marks()
  {
    share_marks();
    unsigned int sweep = 0;
    do
      // deal.II completes the marks (one level of difference between neighbours) with what this
      // rank knows. What it adds at the border of a partition must become known to the neighbour,
      // which may then add more. The limit of sweeps guards against an endless exchange only.
      forest.triangulation.prepare_coarsening_and_refinement();
    while (share_marks() && ++sweep < 20);
  }



  bool
  Refinement::mark(const Step &problem, const double time)
  {
    auto &mesh = forest.triangulation;

    const double high  = bulk_threshold(variation, parameters.contact_fraction),
                 large = bulk_threshold(errors, parameters.refine_fraction);
    // The same bulk criterion from the other end: the cells below the threshold of the largest 98 %
    // make up the smallest 2 %.
    const double small = bulk_threshold(errors, 1. - parameters.coarsen_fraction),
                 low   = bulk_threshold(variation, 1. - parameters.coarsen_fraction);
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int i = cell->active_cell_index();
          if (variation(i) >= high || errors(i) >= large ||
              (region && region->value(cell->center(), time) > 0.))
            {
              if (cell->level() < finest_level())
                cell->set_refine_flag();
            }
          // Coarsening only where both indicators are small, and never beyond the initial mesh. No
          // variation at all is the case away from the contact.
          else if (parameters.coarsen_fraction > 0. && errors(i) < small &&
                   (variation(i) < low || variation(i) == 0.) &&
                   static_cast<unsigned int>(cell->level()) > forest.first_level())
            cell->set_coarsen_flag();
        }
    // The region's formula was evaluated on this rank's cells: a failure is thrown on all ranks
    // together.
    formulas.check(solid.communicator);
    // Slave faces finer than the master faces they meet have oscillating pressures (doc/theory.md
    // 11, "Marking"). Completing the marks may refine further slave faces, which master faces have
    // to follow in turn: repeated until nothing is added.
    unsigned int sweep = 0;
    do
      settle_marks();
    while (follow_slaves(problem) && ++sweep < 20);

    unsigned int finer = 0;
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        finer += cell->refine_flag_set();
    // Each refined cell becomes eight, seven more. If that exceeds the limit no cell is refined at
    // all, since any choice of a part would be arbitrary; coarsening remains.
    finer         = Utilities::MPI::sum(finer, solid.communicator);
    no_more_cells = finer > 0 && mesh.n_global_active_cells() + 7 * std::uint64_t(finer) >
                                   parameters.maximum_cells;
    if (no_more_cells)
      {
        for (const auto &cell : mesh.active_cell_iterators())
          cell->clear_refine_flag();
        settle_marks();
      }

    int changes = 0;
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        // After completion of the marks nothing may be left of them; then the step is not solved
        // again.
        changes |= (cell->refine_flag_set() || cell->coarsen_flag_set());
    return Utilities::MPI::max(changes, solid.communicator) == 1;
  }
} // namespace Touchstone
