// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/interruption.h>
#include <touchstone/drive/simulation.h>

#include <cmath>
#include <limits>
#include <string>

// One step of a run: solved, and on adaptive meshes solved again after each change of the mesh
// (doc/theory.md 11).
namespace Touchstone
{
  using namespace dealii;

  unsigned int
  Simulation::solve_step(const double time)
  {
    // No state yet: RepeatedFailure tells by the NaN residual that an attempt failed before its
    // first iteration.
    last_state          = NewtonState();
    last_state.residual = std::numeric_limits<double>::quiet_NaN();
    // The observer runs after each iteration, so that the iterations of attempts which fail later
    // are counted, too: they are work done.
    return problem->solve(
      time,
      scene.newton,
      [&](const unsigned int iteration, const NewtonState &state, const int linear) {
        last_state = state;
        progress.iteration(
          {iteration, state.residual, state.gap, state.active, state.changes, linear});
        if (state.fraction < 1.)
          {
            ++summary.iterations.damped;
            log.line("             with " + std::to_string(state.fraction).substr(0, 6) +
                     " of the increment: all of it had made things worse");
          }
        ++summary.iterations.newton;
        Interruption::check(communicator);
        summary.iterations.contact += (state.changes > 0);
      });
  }



  void
  Simulation::tell_of_estimate()
  {
    if (scene.refinement.estimator == RefinementParameters::Estimator::contact_force &&
        scene.has_friction())
      warnings.add("the estimated errors of contact forces leave out what the mesh makes of "
                   "friction ('Refinement/Estimator'): they may be of another size and sign");
    for (const auto &[pair, reason] : refinement.missing())
      warnings.add(
        "the error of the force of contact pair '" + scene.pairs[pair].name +
        "' is not estimated in all steps, nor is 'Refinement/Tolerance' reached there: " + reason);
  }



  unsigned int
  Simulation::adapt(const unsigned int step, const double time)
  {
    unsigned int       newton = 0;
    const unsigned int cycles =
      step == 1 ? scene.refinement.cycles : scene.refinement.cycles_per_step;
    if (!scene.refinement.active())
      return 0;
    // Cycle of doc/theory.md 11: estimate, mark, refine, and solve the same step again from its
    // beginning. The estimate of the last mesh is recorded, but not used. A step is committed only
    // after its last cycle, so the next step begins on the mesh on which this one was solved.
    for (unsigned int cycle = 0;; ++cycle)
      {
        StepTransfer transfer;
        {
          TimerOutput::Scope scope(timer, "refinement");
          const double       error = refinement.estimate(*problem);
          summary.meshes.push_back({step, summary.cells, summary.unknowns, error});
          tell_of_estimate();
          if (cycle == cycles || error < scene.refinement.tolerance)
            return newton;
          const bool marked = refinement.mark(*problem, time);
          if (refinement.limited())
            warnings.add("the mesh is not refined, for it would have more cells than "
                         "\"Refinement/Maximum cells\", which are " +
                         std::to_string(scene.refinement.maximum_cells));
          if (!marked)
            return newton;
          // Both states go over: the committed one as the beginning of the step, the present one as
          // initial guess. The old problem still refers to the dofs of the old mesh and is replaced
          // at once.
          transfer        = problem->transfer();
          transfer.fields = refinement.execute(transfer.fields);
          volume_output.reinit();
          probes.reinit();
        }
        // A problem begins with virgin bodies at time 0, whose stiffness damps; what has become of
        // them is given back afterwards, as when a run is resumed.
        const MaterialHistory history = solid.take_history();
        problem                       = Step::make(scene, forest, solid, timer);
        problem->start();
        solid.give_history(history, transfer.committed_time);
        problem->adopt(transfer, time);
        summary.cells    = forest.triangulation.n_global_active_cells();
        summary.unknowns = solid.dof_handler.n_dofs();
        log.line("  mesh " + std::to_string(summary.meshes.size() + 1) + ": " +
                 std::to_string(summary.cells) + " cells, " + std::to_string(summary.unknowns) +
                 " unknowns");
        newton += solve_step(time);
      }
  }
} // namespace Touchstone
