// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/results.h>
#include <touchstone/drive/boundary_faces.h>
#include <touchstone/drive/force_estimate.h>
#include <touchstone/drive/refinement.h>
#include <touchstone/solid/error_estimator.h>
#include <touchstone/solid/state_transfer.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/solution_transfer.h>

#include <algorithm>
#include <cmath>

/**
 * @file
 * Adaptive meshes (doc/theory.md 11): Simulation::adapt() calls estimate(), mark() and execute()
 * after a step has been solved, and solves the step again on the new mesh. All functions are
 * collective. Marks are made in refinement_marks.cc, those of master faces in
 * refinement_masters.cc.
 */

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
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



  namespace
  {
    /** Relative errors below this are those of the solution of the equations: of an exact solution
     * they would refine cells at random. */
    constexpr double of_solver = 1e-6;
  } // namespace



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
        const Vector &field    = fields[Contact::n_fields * p];
        const Vector  traction = conforming(field, solid);
        const double  least    = of_solver * field.linfty_norm();
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
                        if ((highest - lowest).norm() > least)
                          result(cell->active_cell_index()) +=
                            cell->face(f)->measure() * (highest - lowest).norm_square();
                      });
      }
    return result;
  }



  double
  Refinement::estimate(Step &problem)
  {
    using Estimator = RefinementParameters::Estimator;
    const Vector u  = problem.state().ghosted_displacement();
    errors.reinit(forest.triangulation.n_active_cells());
    variation.reinit(forest.triangulation.n_active_cells());
    without.clear();
    // The region needs no error estimate, and gives none.
    if (parameters.estimator == Estimator::region)
      return std::nan("");
    if (parameters.estimator == Estimator::kelly)
      errors = jump_errors(solid, u);
    else if (parameters.estimator == Estimator::recovered_stress)
      errors = recovery_errors(solid, u);
    variation           = pressure_variation(problem.state().contact.fields(false),
                                   pair_boundaries(problem.state().contact));
    const double energy = problem.state().strain_energy();
    // In free flight the stress is round-off, and so would be its estimated error: the mesh would
    // be refined at random.
    if (energy <=
        solid.round_off(problem.state().displacement) * problem.state().displacement.l2_norm())
      {
        errors = 0.;
        std::fill(forces.begin(), forces.end(), std::nan(""));
        return parameters.estimator == Estimator::contact_force ? std::nan("") : 0.;
      }
    if (parameters.estimator == Estimator::contact_force)
      {
        const ForceEstimate estimate(problem);
        errors  = estimate.cells;
        forces  = estimate.relative;
        without = estimate.missing;
        return estimate.largest();
      }
    // Relative error in the energy norm, (Sum eta_K^2 / 2E)^(1/2), doc/theory.md 11, "Estimators".
    const double squared  = Utilities::MPI::sum(errors.l1_norm(), solid.communicator),
                 relative = energy > 0. ? std::sqrt(squared / (2. * energy)) : 0.;
    if (relative < of_solver)
      errors = 0.;
    return relative;
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

    std::vector<Vector>   result(fields.size(), solid.zero_vector());
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
