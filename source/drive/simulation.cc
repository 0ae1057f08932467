// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/base/non_convergence.h>
#include <touchstone/contact/contact_counts.h>
#include <touchstone/contact/overlapping_bodies.h>
#include <touchstone/contact/results.h>
#include <touchstone/drive/simulation.h>
#include <touchstone/mesh/geometry.h>
#include <touchstone/output/resources.h>
#include <touchstone/scene/parameter_changes.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <limits>
#include <sstream>

/**
 * @file
 * A run from the scene to the summary: run() starts or resumes the problem, load_stepping() makes
 * the steps (solve, adapt the mesh, commit or cut) and record_step() turns each committed step into
 * results. Checkpoints and resuming are in restart.cc. The same is executed on all ranks: nothing
 * here may depend on the rank but output.
 */

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    std::shared_ptr<ReferenceSolution>
    make_reference(const Scene &scene)
    {
      // The constructor of a reference solution checks the values given for it, so a mistake there
      // ends the run before it begins.
      const std::shared_ptr<ReferenceSolution> result = scene.reference.type.make(scene);
      if (!result)
        throw InputError("Reference solution",
                         "Type",
                         scene.reference.type.name,
                         "there is no such reference solution",
                         "choose one of " + ReferenceRegistry::selection() + ".");
      return result;
    }

    std::string
    complete_parameters(const Scene &scene)
    {
      std::ostringstream text;
      scene.print(text);
      return text.str();
    }
  } // namespace



  Simulation::Simulation(const Scene       &scene,
                         const std::string &folder_of_scene,
                         std::ostream      *terminal,
                         const MPI_Comm     communicator,
                         const bool         resume)
    : scene(scene)
    , communicator(communicator)
    , origin(find_origin(scene, resume, communicator))
    , changed_parameters(
        resume ? compare_parameters(origin.checkpoint->parameters(), scene, origin.checkpoint->time)
               : std::vector<std::string>())
    // A timer without a communicator: one with a communicator synchronises in its destructor, and
    // would wait for the other ranks for ever when an exception leaves this one alone.
    , timer(std::cout, TimerOutput::never, TimerOutput::wall_times)
    , folder(scene.output.directory, communicator)
    , log(folder, terminal, resume)
    , warnings(log)
    , forest(scene.forest_input(), folder_of_scene, communicator)
    , solid(scene.bodies, scene.discretisation.degree, forest, communicator)
    , problem(Step::make(scene, forest, solid, timer))
    , refinement(scene.refinement, forest, solid)
    , progress(log, scene.load_stepping.end_time)
    , statistics(folder)
    , volume_output(solid, folder)
    , contact_output(folder)
    , reference(make_reference(scene))
    , checkpoints(folder, origin.checkpoint)
    , repeated_failure(scene.newton)
  {
    // The complete scene with all defaults, so that a result can be reproduced with a version whose
    // defaults differ.
    folder.write_file_atomically("parameters.prm", complete_parameters(scene));
    summary.title    = scene.title;
    summary.version  = TOUCHSTONE_VERSION;
    summary.ranks    = Utilities::MPI::n_mpi_processes(communicator);
    summary.cells    = forest.triangulation.n_global_active_cells();
    summary.unknowns = solid.dof_handler.n_dofs();
    if (scene.time_integration.dynamic())
      summary.motion.emplace();
    for (const BodyParameters &body : scene.bodies)
      mesh_files.push_back(body.geometry->fingerprint(folder_of_scene));
  }



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
        summary.iterations.contact += (state.changes > 0);
      });
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
          if (cycle == cycles || error < scene.refinement.tolerance ||
              !refinement.mark(*problem, time))
            return newton;
          // Both states go over: the committed one as the beginning of the step, the present one as
          // initial guess. The old problem still refers to the dofs of the old mesh and is replaced
          // at once.
          transfer        = problem->transfer();
          transfer.fields = refinement.execute(transfer.fields);
          volume_output.reinit();
        }
        problem = Step::make(scene, forest, solid, timer);
        problem->start();
        problem->adopt(transfer, time);
        summary.cells    = forest.triangulation.n_global_active_cells();
        summary.unknowns = solid.dof_handler.n_dofs();
        log.line("  mesh " + std::to_string(summary.meshes.size() + 1) + ": " +
                 std::to_string(summary.cells) + " cells, " + std::to_string(summary.unknowns) +
                 " unknowns");
        newton += solve_step(time);
      }
  }



  void
  Simulation::write_vtu(const unsigned int step, const double time)
  {
    if (last_vtu_step == step)
      return;
    TimerOutput::Scope scope(timer, "output");
    last_vtu_step = step;
    // Ghost values are collective, and so are both outputs: all ranks get here together.
    const Vector u     = problem->state().ghosted_displacement();
    const auto   rates = problem->state().time_integration.rates();
    Vector       velocity;
    if (!rates.empty())
      velocity = solid.ghosted(*rates.front());
    volume_output.write(u, rates.empty() ? nullptr : &velocity, step, time);
    contact_output.write(contact_faces(problem->state().contact),
                         contact_points(problem->state().contact, u),
                         step,
                         time);
  }



  void
  Simulation::record_energies(const std::vector<PairResult> &results, ConvergedStep &record)
  {
    const Energies &energies  = problem->state().time_integration.committed_energies();
    record.energies["strain"] = energies.strain;
    if (solid.has_history())
      record.energies[solid.plastic() ? "plastic" : "material dissipation"] = energies.plastic;
    if (problem->state().time_integration.dynamic())
      {
        // The ledger of doc/time_integration.md, "The energy ledger".
        record.energies["kinetic"]       = energies.kinetic;
        record.energies["contact"]       = energies.contact;
        record.energies["friction"]      = energies.friction;
        record.energies["damping"]       = energies.damping;
        record.energies["external"]      = energies.external;
        record.energies["balance error"] = energies.balance_error();
        if (const CycleCounts *cycles = problem->cycle_counts())
          {
            record.energies["hourglass"] = energies.hourglass;
            record.energies["viscous"]   = energies.viscous;
            record.cycles.emplace(cycles->cycles, cycles->smallest_step);
            summary.cycles += cycles->cycles;
            if (!scene.pairs.empty())
              {
                record.contact_work = cycles->contact;
                summary.contact_work.add(cycles->contact);
              }
          }
        for (unsigned int p = 0; p < results.size(); ++p)
          summary.motion->add_step(scene.pairs[p].name,
                                   record.time - record.step_size,
                                   record.time,
                                   results[p]);
        const auto momenta = problem->state().time_integration.momenta();
        record.momentum.emplace();
        record.angular_momentum.emplace();
        for (unsigned int b = 0; b < momenta.size(); ++b)
          {
            *record.momentum += momenta[b].linear;
            *record.angular_momentum += momenta[b].angular;
            // Velocity of the centre of mass.
            summary.motion->velocities[scene.bodies[b].name] = momenta[b].linear / momenta[b].mass;
          }
        summary.motion->energies = energies;
      }
    else
      for (const ContactPairParameters &pair : scene.pairs)
        if (pair.friction)
          record.energies["friction"] += summary.contact[pair.name].friction_work;
  }



  void
  Simulation::record_step(const unsigned int step,
                          const double       time,
                          const double       size,
                          const unsigned int newton,
                          const unsigned int cuts)
  {
    const Vector  u       = problem->state().ghosted_displacement();
    const auto    results = pair_results(problem->state().contact, u);
    ConvergedStep record;
    record.solid             = &solid;
    record.displacement      = &u;
    record.points            = contact_points(problem->state().contact, u);
    record.number            = step;
    record.time              = time;
    record.step_size         = size;
    record.newton_iterations = newton;
    // Iterations of this step: all so far less those of earlier steps, failed attempts included.
    record.linear_iterations =
      problem->state().counts.linear.iterations - summary.iterations.linear_total;
    record.cuts                     = cuts;
    summary.iterations.linear_total = problem->state().counts.linear.iterations;
    for (unsigned int p = 0; p < results.size(); ++p)
      {
        const std::string &pair = scene.pairs[p].name;
        record.pairs[pair] = summary.contact[pair] = results[p];
        // For the warning at the end on pairs that have lost their contact.
        if (results[p].active > 0)
          had_contact[pair] = time;
      }
    summary.reactions.clear();
    for (const Reaction &reaction : problem->state().reactions())
      {
        record.reactions[reaction.body + "/" + reaction.boundary] = reaction.force;
        summary.reactions[reaction.body][reaction.boundary]       = reaction.force;
      }
    record_energies(results, record);
    {
      TimerOutput::Scope scope(timer, "output");
      statistics.add_step(record);
    }
    for (const auto &observer : observers)
      observer(record);
    // Zero: no VTU output.
    const unsigned int interval = scene.output.vtu_interval;
    if (interval > 0 && step % interval == 0)
      write_vtu(step, time);
  }



  std::string
  Simulation::describe(const NonConvergence &failure, const bool repeated) const
  {
    std::string text = failure.what();
    // Such failures name their cause themselves.
    if (!failure.shorter_step_may_help())
      return text;
    // Collective: all ranks describe the same position.
    const StepDifficulty difficulty = problem->difficulty();
    if (!difficulty.position.empty())
      text += "; farthest from a solution: " + difficulty.position;
    text += difficulty.suspicion;
    if (!repeated)
      return text;
    std::ostringstream more;
    more << "; the attempt with twice the step failed in the same way, with residual "
         << last_state.residual << ", gap " << last_state.gap << ", " << last_state.active
         << " active rows and " << last_state.changes
         << " that changed, so that smaller steps cannot help. Other choices take other paths: "
            "'Contact/Enforcement', 'Pairing' of the pair, another mesh, slave and master "
            "exchanged";
    if (scene.has_friction())
      more << ", 'Contact/Friction = regularised'";
    return text + more.str();
  }



  void
  Simulation::stop(const std::string &reason, const Position &position)
  {
    summary.failure = reason;
    // The last committed state is written even if the interval of VTU output would have left it
    // out: it is what the user needs to find the cause.
    write_vtu(position.step - 1, position.time);
    write_last_checkpoint(position);
  }



  void
  Simulation::check_lost_contact()
  {
    // In dynamics bodies may separate for good; in statics it usually means that the scene is not
    // what was meant.
    if (scene.time_integration.dynamic())
      return;
    for (const auto &[pair, time] : had_contact)
      if (summary.contact[pair].active == 0)
        warnings.add("contact pair '" + pair + "' had contact until t = " +
                     Utilities::to_string(time) + " and has none at the end");
  }



  void
  Simulation::load_stepping()
  {
    const double end = scene.load_stepping.end_time, nominal = end / scene.load_stepping.steps;
    // A resumed run starts with the position of its checkpoint; size zero stands for a run from the
    // beginning.
    Position at = start;
    if (at.size <= 0.)
      at.size = nominal;
    /**
     * Fraction of the step size that is made next, below 1 if the step is to end where bodies meet
     * ("Adapt steps" of doc/time_integration.md). It is not a cut: later steps have their full size
     * again.
     */
    double part = 1.;
    // The tolerance stands for the round-off of summing up step sizes.
    while (at.time < end * (1. - 1e-12))
      {
        // The last step ends exactly at the end time: neither beyond it, nor just before it, which
        // would leave a step of the size of round-off.
        at.size = std::min(at.size, end - at.time);
        const double next =
          end - at.time - part * at.size < 1e-9 * nominal ? end : at.time + part * at.size;
        // Number of steps in all if none is cut from here on, for the display only.
        const unsigned int expected =
          at.step - 1 + static_cast<unsigned int>(std::ceil((end - at.time) / at.size - 1e-9));
        progress.begin_step(at.step, expected, next);
        try
          {
            part = make_step(at, next);
          }
        catch (const NonConvergence &failure)
          {
            part = 1.;
            if (!cut_step(failure, at, next))
              return;
          }
        catch (const InputError &error)
          {
            // A formula without a finite value at this time is a mistake of the input, found only
            // now: results of earlier steps are kept and written.
            problem->rollback();
            stop(error.what(), {at.time, nominal, at.step, 0});
            throw;
          }
      }
    if (scene.output.vtu_interval > 0)
      write_vtu(at.step - 1, at.time);
    write_last_checkpoint(at);
    summary.converged = true;
  }



  double
  Simulation::make_step(Position &at, const double next)
  {
    const double nominal = scene.load_stepping.end_time / scene.load_stepping.steps;
    const double length  = next - at.time;
    // Solve, adapt the mesh, and solve again; all of it from the same committed state.
    unsigned int newton = solve_step(next);
    newton += adapt(at.step, next);
    // Checks that can still reject the step (bodies thrown off, contact that rows cannot describe)
    // come before try_commit(), since a committed state cannot be withdrawn.
    const StepFindings findings = problem->findings();
    const double       part =
      problem->try_commit(scene.time_integration.smallest_step * nominal / length);
    if (part < 1.)
      {
        // try_commit() returns a fraction of the step just made, which may itself have been
        // shortened: converted to a fraction of the nominal size of this step. The same step is
        // then made again from the committed state.
        const double of_size = part * (length / at.size);
        problem->rollback();
        progress.shorten_step(of_size * at.size);
        return of_size;
      }
    if (!findings.remarks.empty())
      log.line("  " + findings.remarks);
    // From here on the step counts. Failures of later steps are not compared with earlier ones.
    committed_time = at.time = next;
    repeated_failure.forget();
    if (const CycleCounts *cycles = problem->cycle_counts())
      progress.end_step(cycles->cycles,
                        cycles->smallest_step,
                        cycles->cell,
                        1e9 * cycles->seconds * Utilities::MPI::n_mpi_processes(communicator) /
                          (double(summary.cells) * cycles->cycles),
                        scene.pairs.empty() || cycles->seconds == 0.
                          ? 0.
                          : cycles->contact_seconds / cycles->seconds);
    else
      progress.end_step(newton);
    for (const std::string &text : findings.warnings)
      warnings.add(text);
    record_step(at.step, at.time, length, newton, at.cuts);
    log.check();
    summary.steps = at.step;
    ++at.step;
    // Each converged step undoes one cut: the difficulty is often local in time, and the size
    // returns to the user's.
    if (at.cuts > 0)
      {
        at.size *= 2.;
        --at.cuts;
      }
    if (checkpoint_due(at))
      write_checkpoint(at);
    return 1.;
  }



  bool
  Simulation::cut_step(const NonConvergence &failure, Position &at, const double next)
  {
    const bool repeated = repeated_failure.add(failure, last_state, problem->difficulty().position);
    // A failure that repeats itself with half the step does not depend on the step size, and other
    // failures say themselves that a smaller step is no remedy: further cuts would only take time.
    const bool        hopeless = repeated || !failure.shorter_step_may_help();
    const std::string reason   = describe(failure, repeated);
    problem->rollback();
    if (at.cuts >= scene.load_stepping.maximum_cuts || hopeless)
      {
        // The checkpoint of a failed run has the nominal step size: with other parameters (solver,
        // tolerances) the run may resume from there.
        stop(reason + " (step " + std::to_string(at.step) + " at time " + std::to_string(next) +
               ", cut " + std::to_string(at.cuts) + " times)",
             {at.time, scene.load_stepping.end_time / scene.load_stepping.steps, at.step, 0});
        return false;
      }
    ++at.cuts;
    at.size *= 0.5;
    progress.cut_step(reason, at.size);
    return true;
  }



  RunSummary
  Simulation::run()
  {
    if (origin.checkpoint)
      log.line(); // the last line of a run that died may not have ended
    log.line("Touchstone " + summary.version + ", deal.II " DEAL_II_PACKAGE_VERSION ": " +
             summary.title);
    log.line(std::to_string(summary.cells) + " cells, " + std::to_string(summary.unknowns / dim) +
             " nodes, " + std::to_string(summary.unknowns) + " unknowns on " +
             std::to_string(summary.ranks) + " rank(s); " + scene.contact.enforcement.name + ", " +
             scene.linear_solver.type);
    // Start or resume; both return what is worth a line in the log.
    for (const std::string &line : origin.checkpoint ? resume() : problem->start())
      log.line(line);
    try
      {
        load_stepping();
      }
    catch (const InputError &error)
      {
        write_summary();
        log.line(error.what());
        log.check();
        throw;
      }
    write_summary();
    warnings.repeat();
    if (!summary.converged)
      {
        log.line("The run did not converge: " + summary.failure);
        log.line("The last converged state is in " + folder.path("solution.pvd") + ". " +
                 problem->advice());
        // Bodies that friction holds until they snap, or that buckle, leave no static equilibrium
        // nearby. A block pushed along with a coefficient of 2 does so (doc/robustness.md).
        if (!scene.time_integration.dynamic() && summary.steps > 0)
          log.line("Steps that are cut again and again where all went well before can mean that "
                   "there is no equilibrium to go on with, because a body snaps or buckles: with "
                   "inertia ('Time integration/Scheme') the run goes on.");
      }
    log.check();
    return summary;
  }



  void
  Simulation::write_summary()
  {
    check_lost_contact();
    {
      const StepState state = problem->state();
      for (const std::string &text :
           overlapping_bodies(state.contact, state.ghosted_displacement()))
        warnings.add(text);
    }
    finish_summary();
    summary.quantities = statistics.for_summary();
    summary.warnings   = warnings.list();
    if (summary.ranks > 1)
      log.line(summary.balance_line());
    TimerOutput::Scope scope(timer, "output");
    // Atomic: programs that wait for the file never read half of it.
    folder.write_file_atomically("summary.json", summary.to_json().print());
  }



  void
  Simulation::measure_balance()
  {
    // Counts of work per rank and their largest value over the mean: unlike seconds they do not
    // depend on the machine or its load.
    const ContactCounts work = contact_counts(problem->state().contact);
    const std::vector<std::pair<std::string, double>> counts = {
      {"cells", forest.triangulation.n_locally_owned_active_cells()},
      {"unknowns", solid.owned.n_elements()},
      {"neighbours", forest.triangulation.ghost_owners().size()},
      {"slave_rows", work.slave_rows},
      {"master_faces", work.master_faces},
      {"search_candidates", work.search.candidates},
      {"search_messages", work.search.messages},
      {"search_faces_sent", work.search.faces_sent}};
    summary.balance.clear();
    for (const auto &[phase, mine] : counts)
      {
        const auto all = Utilities::MPI::min_max_avg(mine, communicator);
        summary.balance.push_back({phase, {all.avg, all.max}});
      }
  }



  RunSummary::Seconds
  Simulation::seconds_so_far()
  {
    RunSummary::Seconds result;
    auto                phases = timer.get_summary_data(TimerOutput::total_wall_time);
    // Seconds of the run before it was resumed are included.
    result.assembly      = earlier_seconds.assembly + phases["assembly"];
    result.linear_solver = earlier_seconds.linear_solver + phases["linear solver"];
    result.search        = earlier_seconds.search + phases["search"];
    result.output        = earlier_seconds.output + phases["output"];
    result.wall          = earlier_seconds.wall + wall.wall_time();
    result.cpu           = earlier_seconds.cpu + cpu_seconds(communicator);
    return result;
  }



  void
  Simulation::finish_summary()
  {
    measure_balance();
    if (summary.converged)
      {
        const Vector   u = problem->state().ghosted_displacement();
        ReferenceInput input;
        input.solid        = &solid;
        input.displacement = &u;
        input.points       = contact_points(problem->state().contact, u);
        input.pair_results = pair_results(problem->state().contact, u);
        input.motion       = summary.motion ? &*summary.motion : nullptr;
        input.communicator = communicator;
        // Only a converged run is compared: the exact solution is that of the end time.
        const ReferenceComparison result = reference->compare(input);
        summary.errors                   = result.errors;
        comparison_lines                 = result.lines;
      }
    for (const auto &[body, strain] : solid.largest_plastic_strain())
      summary.plastic_strain[scene.bodies[body].name] = strain;
    const LinearSolverCounts counts = problem->state().counts.linear;
    summary.iterations.linear_total = counts.iterations;
    summary.iterations.linear_mean =
      counts.solves > 0 ? double(counts.iterations) / counts.solves : 0.;
    summary.counts.assemblies            = problem->state().counts.assemblies;
    summary.counts.factorisations        = counts.factorisations;
    summary.counts.preconditioner_setups = counts.preconditioner_setups;
    summary.counts.searches              = problem->state().counts.searches;

    summary.seconds        = seconds_so_far();
    summary.peak_memory_mb = peak_memory_mb(communicator);
  }



  std::vector<std::string>
  validate(const Scene &scene, const std::string &folder_of_scene, const MPI_Comm communicator)
  {
    make_reference(scene);
    const Forest forest(scene.forest_input(), folder_of_scene, communicator);
    Solid        solid(scene.bodies, scene.discretisation.degree, forest, communicator);
    TimerOutput  timer(std::cout, TimerOutput::never, TimerOutput::wall_times);
    // The first linear system is set up but not solved: this evaluates meshes, boundaries, initial
    // gaps and formulas, and finds bodies that nothing holds.
    const std::unique_ptr<Step>    problem = Step::make(scene, forest, solid, timer);
    const std::vector<std::string> lines   = problem->start();
    problem->prepare(scene.load_stepping.end_time / scene.load_stepping.steps);
    return problem->cycle_counts() != nullptr ? lines : std::vector<std::string>();
  }
} // namespace Touchstone
