// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/results.h>
#include <touchstone/drive/refinement.h>
#include <touchstone/solid/error_estimator.h>
#include <touchstone/solid/state_transfer.h>

#include <deal.II/distributed/solution_transfer.h>
#include <deal.II/grid/grid_tools.h>

#include <cmath>

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

    /** First unknowns of the nodes on a face. */
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

    /** Side length of a face. */
    template <class Cell>
    double
    size(const Cell &cell, const unsigned int f)
    {
      return std::sqrt(cell->face(f)->measure());
    }

    /** What it will be as marked. */
    template <class Cell>
    double
    size_to_come(const Cell &cell, const unsigned int f)
    {
      const double factor = cell->refine_flag_set() ? 0.5 : cell->coarsen_flag_set() ? 2. : 1.;
      return factor * size(cell, f);
    }

    /** Sums of this power of one over the size of faces tell the size of the
     * finest: that of ten equal ones by 15 per cent, and meshes differ by factors of two. */
    constexpr double sharpness = 16.;

    /** With ghosts, and what hanging nodes follow. */
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
    region = formulas.add("Refinement", "Region", parameters.region);
  }



  int
  Refinement::finest_level() const
  {
    return std::min<int>(10, forest.first_level() + parameters.maximum_level);
  }



  double
  Refinement::bulk_threshold(const Values &values, const double fraction) const
  {
    const double total = Utilities::MPI::sum(values.l1_norm(), solid.communicator);
    double       low = 0., high = Utilities::MPI::max(values.linfty_norm(), solid.communicator);
    if (total <= 0. || fraction <= 0.)
      return std::numeric_limits<double>::max();
    // The same steps on all ranks; halved in the exponent, as errors span decades.
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
    // Cells that are alike but for round-off are marked together.
    return (1. - 1e-4) * low;
  }



  Refinement::Values
  Refinement::pressure_variation(const std::vector<Vector>         &fields,
                                 const std::vector<PairBoundaries> &pairs) const
  {
    Values result(forest.triangulation.n_active_cells());
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
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
                    const double finer = length / size_to_come(cell, f);
                    for (const Index node : face_nodes(solid, cell, f))
                      at_slaves(node) += std::pow(finer, sharpness);
                  });
    at_slaves.compress(VectorOperation::add);
    solid.condense(at_slaves);
    for (const ContactRow &row : problem.contact_state().pair(pair).rows())
      if (problem.contact_state().state(row).active())
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
    const auto pairs   = pair_boundaries(problem.contact_state());
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        if (pairs[p].master.empty())
          continue;
        double length = 0.;
        for_each_face(solid,
                      pairs[p].slave_body,
                      pairs[p].slave,
                      [&](const auto &cell, const unsigned int f) {
                        length = std::max(length, 2. * size(cell, f));
                      });
        length               = Utilities::MPI::max(length, solid.communicator);
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
    const Vector u  = problem.ghosted_displacement();
    errors.reinit(forest.triangulation.n_active_cells());
    variation.reinit(forest.triangulation.n_active_cells());
    if (parameters.estimator == Estimator::region)
      return 0.;
    errors =
      parameters.estimator == Estimator::kelly ? jump_errors(solid, u) : recovery_errors(solid, u);
    variation           = pressure_variation(problem.contact_state().fields(false),
                                   pair_boundaries(problem.contact_state()));
    const double energy = problem.strain_energy();
    // A body in free flight: what round-off makes of no stress says nothing of the mesh.
    if (energy <= solid.round_off(problem.displacement()) * problem.displacement().l2_norm())
      {
        errors = 0.;
        return 0.;
      }
    const double squared = Utilities::MPI::sum(errors.l1_norm(), solid.communicator);
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
    using Cell      = Triangulation<dim>::active_cell_iterator;
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
        // Its owner knows of the whole family, this rank perhaps not.
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
      forest.triangulation.prepare_coarsening_and_refinement();
    while (share_marks() && ++sweep < 20);
  }



  bool
  Refinement::mark(const Step &problem, const double time)
  {
    auto &mesh = forest.triangulation;

    const double high  = bulk_threshold(variation, parameters.contact_fraction),
                 large = bulk_threshold(errors, parameters.refine_fraction);
    // What is left over by the largest 98 % are the smallest 2 %.
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
          else if (parameters.coarsen_fraction > 0. && errors(i) < small &&
                   (variation(i) < low || variation(i) == 0.) &&
                   static_cast<unsigned int>(cell->level()) > forest.first_level())
            cell->set_coarsen_flag();
        }
    formulas.check(solid.communicator);
    // Slave faces that are finer than the master faces they meet have pressures that
    // oscillate. What the mesh adds to the marks may be slave faces, and so on.
    unsigned int sweep = 0;
    do
      settle_marks();
    while (follow_slaves(problem) && ++sweep < 20);

    unsigned int finer = 0;
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        finer += cell->refine_flag_set();
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
        changes |= (cell->refine_flag_set() || cell->coarsen_flag_set());
    return Utilities::MPI::max(changes, solid.communicator) == 1;
  }



  std::vector<Vector>
  Refinement::carry_over(const std::vector<Vector> &fields, const std::function<void()> &change)
  {
    parallel::distributed::SolutionTransfer<dim, Vector> transfer(solid.dof_handler);
    // Ghosts cannot be assigned to a vector that has none.
    std::vector<Vector> with_ghosts;
    for (const Vector &field : fields)
      with_ghosts.push_back(conforming(field, solid));
    std::vector<const Vector *> before;
    for (const Vector &field : with_ghosts)
      before.push_back(&field);
    transfer.prepare_for_coarsening_and_refinement(before);
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
    // The weights of cells have been estimated for their children.
    if (forest.weighted())
      result = carry_over(result, [this]() { forest.repartition(); });
    return result;
  }
} // namespace Touchstone
