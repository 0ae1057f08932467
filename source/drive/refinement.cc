#include <touchstone/drive/refinement.h>
#include <touchstone/scene/expression.h>
#include <touchstone/solid/error_estimator.h>
#include <touchstone/solid/state_transfer.h>

#include <deal.II/distributed/solution_transfer.h>
#include <deal.II/grid/grid_refinement.h>

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
            if (cell->face(f)->at_boundary() && boundaries.count(cell->face(f)->boundary_id()) > 0)
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

    /** With ghosts, and what hanging nodes follow. */
    Vector
    conforming(const Vector &field, const Solid &solid)
    {
      Vector owned(field);
      solid.hanging.distribute(owned);
      return solid.ghosted(owned);
    }
  } // namespace



  Refinement::Refinement(const Scene &scene, Forest &forest, Solid &solid)
    : scene(scene)
    , forest(forest)
    , solid(solid)
  {
    if (!scene.refinement.region.empty())
      region = make_function(scene.refinement.region);
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
  Refinement::pressure_variation(const std::vector<Vector>                  &fields,
                                 const std::vector<Contact::PairBoundaries> &pairs) const
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



  void
  Refinement::mark_masters(const StepProblem &problem, std::vector<bool> &marked) const
  {
    const auto pairs = problem.contact_state().boundaries();
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        if (pairs[p].master.empty())
          continue;
        // Slave nodes of marked faces, with the size of these; then what their
        // stencils refer to, with the mean of the sizes.
        Vector count(solid.owned, solid.communicator), size(count);
        for_each_face(solid,
                      pairs[p].slave_body,
                      pairs[p].slave,
                      [&](const auto &cell, const unsigned int f) {
                        if (marked[cell->active_cell_index()])
                          for (const Index node : face_nodes(solid, cell, f))
                            {
                              count(node) += 1.;
                              size(node) += std::sqrt(cell->face(f)->measure());
                            }
                      });
        count.compress(VectorOperation::add);
        size.compress(VectorOperation::add);
        solid.condense(count);
        solid.condense(size);
        Vector master_count(solid.owned, solid.communicator), master_size(master_count);
        for (const ContactRow &row : problem.contact_state().rows[p])
          if (row.active() && count(dim * row.slave) > 0.)
            for (const StencilEntry &entry : row.stencil)
              if (entry.weight > 0.)
                {
                  master_count(dim * entry.node) += entry.weight * count(dim * row.slave);
                  master_size(dim * entry.node) += entry.weight * size(dim * row.slave);
                }
        master_count.compress(VectorOperation::add);
        master_size.compress(VectorOperation::add);
        const Vector all_count = solid.ghosted(master_count), all_size = solid.ghosted(master_size);
        for_each_face(solid,
                      pairs[p].master_body,
                      pairs[p].master,
                      [&](const auto &cell, const unsigned int f) {
                        double faces = 0., sum = 0.;
                        for (const Index node : face_nodes(solid, cell, f))
                          {
                            faces += all_count(node);
                            sum += all_size(node);
                          }
                        if (faces > 0.5 && std::sqrt(cell->face(f)->measure()) > 0.7 * sum / faces)
                          marked[cell->active_cell_index()] = true;
                      });
      }
  }



  double
  Refinement::estimate(const StepProblem &problem)
  {
    const std::string &estimator = scene.refinement.estimator;
    const Vector       u         = problem.ghosted_displacement();
    errors.reinit(forest.triangulation.n_active_cells());
    variation.reinit(forest.triangulation.n_active_cells());
    if (estimator == "region")
      return 0.;
    errors = estimator == "Kelly" ? jump_errors(scene, solid, u) : recovery_errors(scene, solid, u);
    variation            = pressure_variation(problem.contact_state().fields(false),
                                   problem.contact_state().boundaries());
    const double energy  = problem.strain_energy();
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
  Refinement::mark(const StepProblem &problem, const double time)
  {
    const RefinementParameters &parameters = scene.refinement;
    auto                       &mesh       = forest.triangulation;

    std::vector<bool> refine(mesh.n_active_cells());
    const double      high = bulk_threshold(variation, parameters.contact_fraction);
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        refine[cell->active_cell_index()] = variation(cell->active_cell_index()) >= high;
    mark_masters(problem, refine);
    const double large = bulk_threshold(errors, parameters.refine_fraction);
    // What is left over by the largest 98 % are the smallest 2 %.
    const double small = bulk_threshold(errors, 1. - parameters.coarsen_fraction),
                 low   = bulk_threshold(variation, 1. - parameters.coarsen_fraction);
    if (region)
      region->set_time(time);

    unsigned int       finer = 0;
    const unsigned int finest =
      std::min<unsigned int>(10, forest.first_level() + parameters.maximum_level);
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int i = cell->active_cell_index();
          if (refine[i] || errors(i) >= large || (region && region->value(cell->center()) > 0.))
            {
              if (static_cast<unsigned int>(cell->level()) < finest)
                {
                  cell->set_refine_flag();
                  ++finer;
                }
            }
          else if (parameters.coarsen_fraction > 0. && errors(i) < small &&
                   (variation(i) < low || variation(i) == 0.) &&
                   static_cast<unsigned int>(cell->level()) > forest.first_level())
            cell->set_coarsen_flag();
        }
    finer = Utilities::MPI::sum(finer, solid.communicator);
    if (mesh.n_global_active_cells() + 7 * std::uint64_t(finer) > parameters.maximum_cells)
      for (const auto &cell : mesh.active_cell_iterators())
        cell->clear_refine_flag();
    mesh.prepare_coarsening_and_refinement();

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
