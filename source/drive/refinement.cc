// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/results.h>
#include <touchstone/drive/refinement.h>
#include <touchstone/solid/error_estimator.h>
#include <touchstone/solid/state_transfer.h>

#include <deal.II/distributed/solution_transfer.h>
#include <deal.II/grid/grid_tools.h>

#include <cmath>

/**
 * @file
 * Adaptive meshes (doc/theory.md 11): Simulation::adapt() calls estimate(), mark() and execute()
 * after a step has been solved, and solves the step again on the new mesh. All decisions are
 * collective and symmetric between ranks: marks are exchanged with the ghost cells until nothing
 * changes, so that the mesh does not depend on the partition.
 */

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Visit the faces of owned cells of one body that lie on some of its
     * boundaries. */
    template <class Visitor>
    void
    for_each_face(const Solid                        &solid,
                  const unsigned int                  body,
                  const std::set<types::boundary_id> &boundaries,
                  const Visitor                      &visit)
    {
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && cell->material_id() == body)
          for (const unsigned int f : cell->face_indices())
            if (cell->at_boundary(f) && boundaries.count(cell->face(f)->boundary_id()) > 0)
              visit(cell, f);
    }

    /**
     * Index of the first component's dof of each node on a face; the other components follow it.
     */
    template <class Cell>
    std::vector<Index>
    face_nodes(const Solid &solid, const Cell &cell, const unsigned int f)
    {
      std::vector<Index> dofs(solid.fe.n_dofs_per_cell()), result;
      cell->get_dof_indices(dofs);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (solid.fe.system_to_component_index(i).first == 0 && solid.fe.has_support_on_face(i, f))
          result.push_back(dofs[i]);
      return result;
    }

    /** Mean side length of a face, length: the square root of its area. */
    template <class Cell>
    double
    size(const Cell &cell, const unsigned int f)
    {
      return std::sqrt(cell->face(f)->measure());
    }

    /** Side length that the face will have after the marked refinement or coarsening. */
    template <class Cell>
    double
    size_to_come(const Cell &cell, const unsigned int f)
    {
      const double factor = cell->refine_flag_set() ? 0.5 : cell->coarsen_flag_set() ? 2. : 1.;
      return factor * size(cell, f);
    }

    /**
     * Exponent of a p-norm that stands for a maximum: the smallest face size at a node is obtained
     * as (sum 1/h^16)^(-1/16), since vectors are summed and not maximised over ranks. Ten equal
     * faces make an error of 15 per cent, while the sizes of refined meshes differ by factors of
     * two.
     */
    constexpr double sharpness = 16.;

    /** The field with hanging nodes interpolated and with ghost values. */
    Vector
    conforming(const Vector &field, const Solid &solid)
    {
      Vector owned(field);
      solid.hanging.distribute(owned);
      return solid.ghosted(owned);
    }
  } // namespace



  Refinement::Refinement(const RefinementParameters &parameters, Forest &forest, Solid &solid)
    : parameters(parameters)
    , forest(forest)
    , solid(solid)
  {
    // Null if no region is given.
    region = formulas.add("Refinement", "Region", parameters.region);
  }



  int
  Refinement::finest_level() const
  {
    // "Maximum level" counts from the mesh of the scene, levels from the coarse cells of
    // the forest.
    return std::min<int>(10, forest.first_level() + parameters.maximum_level);
  }



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



  Refinement::Values
  Refinement::pressure_variation(const std::vector<Vector>         &fields,
                                 const std::vector<PairBoundaries> &pairs) const
  {
    Values result(forest.triangulation.n_active_cells());
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        // Indicator at the contact: A_F |max t - min t|^2 of the nodal tractions t on each slave
        // face F. It has the same dimension for all faces, so that only ratios enter the bulk
        // criterion.
        const Vector traction = conforming(fields[Contact::n_fields * p], solid);
        for_each_face(solid,
                      pairs[p].slave_body,
                      pairs[p].slave,
                      [&](const auto &cell, const unsigned int f) {
                        Tensor<1, dim> lowest, highest;
                        bool           first = true;
                        for (const Index node : face_nodes(solid, cell, f))
                          {
                            for (unsigned int d = 0; d < dim; ++d)
                              {
                                const double value = traction(node + d);
                                lowest[d]          = first ? value : std::min(lowest[d], value);
                                highest[d]         = first ? value : std::max(highest[d], value);
                              }
                            first = false;
                          }
                        result(cell->active_cell_index()) +=
                          cell->face(f)->measure() * (highest - lowest).norm_square();
                      });
      }
    return result;
  }



  Vector
  Refinement::faces_at_masters(const Step           &problem,
                               const unsigned int    pair,
                               const PairBoundaries &boundaries,
                               const double          length,
                               const bool            refined_only) const
  {
    Vector at_slaves(solid.owned, solid.communicator), at_masters(at_slaves);
    for_each_face(solid,
                  boundaries.slave_body,
                  boundaries.slave,
                  [&](const auto &cell, const unsigned int f) {
                    if (refined_only && !cell->refine_flag_set())
                      return;
                    // length is at least the size of any face to come, so that the ratios are at
                    // least one and their 16th power neither over- nor underflows.
                    const double finer = length / size_to_come(cell, f);
                    for (const Index node : face_nodes(solid, cell, f))
                      at_slaves(node) += std::pow(finer, sharpness);
                  });
    at_slaves.compress(VectorOperation::add);
    // Hanging nodes have no row: their part goes to the nodes that they follow.
    solid.condense(at_slaves);
    // Each active row passes the face size at its slave node on to the master nodes in its stencil.
    // Negative weights occur (dual basis) and are left out, as they would spoil the root.
    for (const ContactRow &row : problem.state().contact.pair(pair).rows())
      if (problem.state().contact.state(row).active())
        if (const double value = at_slaves(dim * row.slave); value > 0.)
          for (const StencilEntry &entry : row.stencil)
            if (entry.weight > 0.)
              at_masters(dim * entry.node) += entry.weight * value;
    at_masters.compress(VectorOperation::add);
    return solid.ghosted(at_masters);
  }



  bool
  Refinement::follow_slaves(const Step &problem)
  {
    int        changes = 0;
    const auto pairs   = pair_boundaries(problem.state().contact);
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        // An obstacle has no mesh.
        if (pairs[p].master.empty())
          continue;
        double length = 0.;
        for_each_face(solid,
                      pairs[p].slave_body,
                      pairs[p].slave,
                      [&](const auto &cell, const unsigned int f) {
                        // Twice the largest slave face, since coarsening doubles sizes.
                        length = std::max(length, 2. * size(cell, f));
                      });
        length = Utilities::MPI::max(length, solid.communicator);
        // Two fields: refinement of master faces follows the refined slave faces only, for the
        // initial mesh is the user's choice; but no master face is coarsened beyond any slave face
        // it meets.
        const Vector refined = faces_at_masters(problem, p, pairs[p], length, true),
                     all     = faces_at_masters(problem, p, pairs[p], length, false);
        for_each_face(solid,
                      pairs[p].master_body,
                      pairs[p].master,
                      [&](const auto &cell, const unsigned int f) {
                        const auto coarse = [&](const Vector &slaves) {
                          double finest_slave = 0.;
                          for (const Index node : face_nodes(solid, cell, f))
                            finest_slave = std::max(finest_slave, slaves(node));
                          return finest_slave > 0. &&
                                 size_to_come(cell, f) >
                                   // The factor 1.4, about the square root of two, lies halfway
                                   // between equal size and one level coarser.
                                   1.4 * length * std::pow(finest_slave, -1. / sharpness);
                        };
                        if (cell->coarsen_flag_set() && coarse(all))
                          {
                            cell->clear_coarsen_flag();
                            changes = 1;
                          }
                        if (!cell->refine_flag_set() && cell->level() < finest_level() &&
                            coarse(refined))
                          {
                            cell->clear_coarsen_flag();
                            cell->set_refine_flag();
                            changes = 1;
                          }
                      });
      }
    return Utilities::MPI::max(changes, solid.communicator) == 1;
  }



  double
  Refinement::estimate(const Step &problem)
  {
    using Estimator = RefinementParameters::Estimator;
    const Vector u  = problem.state().ghosted_displacement();
    errors.reinit(forest.triangulation.n_active_cells());
    variation.reinit(forest.triangulation.n_active_cells());
    // The region needs no error estimate, and gives none.
    if (parameters.estimator == Estimator::region)
      return 0.;
    errors =
      parameters.estimator == Estimator::kelly ? jump_errors(solid, u) : recovery_errors(solid, u);
    variation           = pressure_variation(problem.state().contact.fields(false),
                                   pair_boundaries(problem.state().contact));
    const double energy = problem.state().strain_energy();
    // In free flight the stress is round-off, and so would be its estimated error: the mesh would
    // be refined at random.
    if (energy <=
        solid.round_off(problem.state().displacement) * problem.state().displacement.l2_norm())
      {
        errors = 0.;
        return 0.;
      }
    const double squared = Utilities::MPI::sum(errors.l1_norm(), solid.communicator);
    // Relative error in the energy norm, (Sum eta_K^2 / 2E)^(1/2), doc/theory.md 11, "Estimators".
    return energy > 0. ? std::sqrt(squared / (2. * energy)) : 0.;
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
        // active here.
        else if (mark == coarsen)
          for (unsigned int child = 0; child < cell->parent()->n_children(); ++child)
            if (cell->parent()->child(child)->is_active())
              cell->parent()->child(child)->set_coarsen_flag();
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
    finer = Utilities::MPI::sum(finer, solid.communicator);
    if (mesh.n_global_active_cells() + 7 * std::uint64_t(finer) > parameters.maximum_cells)
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



  std::vector<Vector>
  Refinement::carry_over(const std::vector<Vector> &fields, const std::function<void()> &change)
  {
    parallel::distributed::SolutionTransfer<dim, Vector> transfer(solid.dof_handler);
    // SolutionTransfer reads ghosted vectors, while the fields here have none; hanging nodes must
    // be interpolated first, as their own entries are not meaningful.
    std::vector<Vector> with_ghosts;
    for (const Vector &field : fields)
      with_ghosts.push_back(conforming(field, solid));
    std::vector<const Vector *> before;
    for (const Vector &field : with_ghosts)
      before.push_back(&field);
    transfer.prepare_for_coarsening_and_refinement(before);
    // The history of plastic material lives at quadrature points and has a transfer of its own.
    // Both transfers attach their data to the cells before the mesh changes, and read them in the
    // same order afterwards.
    StateTransfer state_transfer(forest.triangulation, solid);
    change();
    solid.reinit();

    std::vector<Vector>   result(fields.size(), Vector(solid.owned, solid.communicator));
    std::vector<Vector *> after;
    for (Vector &field : result)
      after.push_back(&field);
    transfer.interpolate(after);
    state_transfer.finish();
    for (Vector &field : result)
      solid.hanging.distribute(field);
    return result;
  }



  std::vector<Vector>
  Refinement::execute(const std::vector<Vector> &fields)
  {
    auto &mesh   = forest.triangulation;
    auto  result = carry_over(fields, [&mesh]() { mesh.execute_coarsening_and_refinement(); });
    // During refinement p4est partitions by weights that could only be estimated for the cells to
    // come: with weighted cells the mesh is therefore repartitioned by the true weights afterwards,
    // which moves the fields a second time.
    if (forest.weighted())
      result = carry_over(result, [this]() { forest.repartition(); });
    return result;
  }
} // namespace Touchstone
