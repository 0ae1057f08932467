// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/contact/contact_checks.h>
#include <touchstone/contact/results.h>
#include <touchstone/drive/adjusted_start.h>
#include <touchstone/drive/model_report.h>
#include <touchstone/drive/simulation.h>
#include <touchstone/mesh/geometry.h>
#include <touchstone/mesh/obstacle_shape.h>
#include <touchstone/scene/complete_scene.h>
#include <touchstone/scene/parameter_changes.h>

#include <deal.II/base/mpi.h>

/**
 * @file
 * A run from the scene to the summary: run() starts or resumes the problem, load_stepping() makes
 * the steps (load_stepping.cc; each one is solved and the mesh adapted in adaptive_step.cc), and
 * record_step() turns each committed step into results. VTU files and the summary are written in
 * simulation_output.cc, checkpoints and resuming are in restart.cc. The same is executed on all
 * ranks: nothing here may depend on the rank but output.
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
    , adjusted(adjust_start(scene, forest, communicator))
    , solid(scene.bodies, scene.discretisation.degree, forest, communicator)
    , problem(Step::make(scene, forest, solid, timer))
    , refinement(scene.refinement, forest, solid)
    , progress(log, scene.load_stepping.end_time)
    , statistics(folder)
    , volume_output(solid, folder, scene.output)
    , point_output(solid, folder, scene.output.format)
    , probes(scene.probes, forest, solid)
    , contact_output(folder, scene.output.format)
    , master_output(folder, scene.output.format, "master_contact")
    , reference(make_reference(scene))
    , checkpoints(folder, origin.checkpoint)
    , repeated_failure(scene.newton)
  {
    reference->check_mesh(solid);
    folder.write_file_atomically("parameters.prm", complete_scene(scene, folder_of_scene));
    summary.title    = scene.title;
    summary.version  = TOUCHSTONE_VERSION;
    summary.ranks    = Utilities::MPI::n_mpi_processes(communicator);
    summary.cells    = forest.triangulation.n_global_active_cells();
    summary.unknowns = solid.dof_handler.n_dofs();
    for (const LoadPhase &phase : scene.load_stepping.phases)
      summary.phases.emplace_back(phase.name, phase.end_time);
    if (scene.time_integration.dynamic())
      summary.motion.emplace();
    for (const std::string &text : forest.warnings())
      warnings.add(text);
    for (const BodyParameters &body : scene.bodies)
      mesh_files.push_back(body.geometry->fingerprint(folder_of_scene));
    for (const ObstacleParameters &obstacle : scene.obstacles)
      mesh_files.push_back(obstacle.shape.make()->fingerprint());
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
            if (scene.has_contact())
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
  Simulation::record_start()
  {
    const Vector  u       = problem->state().ghosted_displacement();
    const auto    results = pair_results(problem->state().contact, u);
    ConvergedStep record;
    record.solid        = &solid;
    record.displacement = &u;
    record.points       = contact_points(problem->state().contact, u);
    for (unsigned int p = 0; p < results.size(); ++p)
      record.pairs[scene.pairs[p].name] = results[p];
    record.tools = problem->state().tools;
    for (const Reaction &reaction : problem->state().reactions())
      record.reactions[reaction.body + "/" + reaction.boundary] = reaction.force;
    const CommittedMotion &motion = problem->state().time_integration;
    record.energies["strain"]     = motion.committed_energies().strain;
    if (motion.dynamic())
      {
        record.energies["kinetic"] = motion.committed_energies().kinetic;
        record.momentum.emplace();
        record.angular_momentum.emplace();
        for (const BodyMomentum &momentum : motion.momenta())
          {
            *record.momentum += momentum.linear;
            *record.angular_momentum += momentum.angular;
          }
      }
    remove_earlier_run(0);
    statistics.add_start(record);
    probes.record(folder, volume_output, u, 0.);
    if (scene.output.vtu_interval > 0)
      write_vtu(0, 0.);
  }



  void
  Simulation::record_step(const unsigned int step,
                          const double       time,
                          const double       size,
                          const unsigned int newton,
                          const unsigned int cuts,
                          const unsigned int phase)
  {
    const Vector  u       = problem->state().ghosted_displacement();
    const auto    results = pair_results(problem->state().contact, u);
    ConvergedStep record;
    record.solid        = &solid;
    record.displacement = &u;
    record.points       = contact_points(problem->state().contact, u);
    record.number       = step;
    record.time         = time;
    if (!scene.load_stepping.phases.empty())
      record.phase = phase + 1;
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
    for (std::size_t p = 0; p < refinement.force_errors().size(); ++p)
      record.force_errors[scene.pairs[p].name] = refinement.force_errors()[p];
    record.pretension = problem->state().pretension;
    record.tools      = problem->state().tools;
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
      probes.record(folder, volume_output, u, time);
    }
    for (const auto &observer : observers)
      observer(record);
    // Zero: no VTU output.
    const unsigned int interval = scene.output.vtu_interval;
    if (interval > 0 && step % interval == 0)
      write_vtu(step, time);
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
    for (const std::string &text : scene.without_effect)
      warnings.add(text);
    for (const std::string &line : adjusted)
      log.line(line);
    // Start or resume; both return what is worth a line in the log.
    for (const std::string &line : origin.checkpoint ? resume() : problem->start())
      log.line(line);
    for (const std::string &text : doubtful_ties(problem->state().contact))
      warnings.add(text);
    if (!origin.checkpoint)
      record_start();
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
    if (summary.interrupted)
      log.line("The run was interrupted: " + summary.failure);
    else if (!summary.converged)
      {
        log.line("The run did not converge: " + summary.failure);
        log.line("The last converged state is in " +
                 folder.path(volume_output.series().list_name()) + ". " + problem->advice());
      }
    log.check();
    return summary;
  }



  std::vector<std::string>
  validate(const Scene &scene, const std::string &folder_of_scene, const MPI_Comm communicator)
  {
    const auto reference = make_reference(scene);
    Forest     forest(scene.forest_input(), folder_of_scene, communicator);
    const auto adjusted = adjust_start(scene, forest, communicator);
    Solid      solid(scene.bodies, scene.discretisation.degree, forest, communicator);
    reference->check_mesh(solid);
    const Probes probes(scene.probes, forest, solid);
    TimerOutput  timer(std::cout, TimerOutput::never, TimerOutput::wall_times);
    // The first linear system is set up but not solved: this evaluates meshes, boundaries, initial
    // gaps and formulas, and finds bodies that nothing holds.
    const std::unique_ptr<Step>    problem = Step::make(scene, forest, solid, timer);
    const std::vector<std::string> start   = problem->start();
    problem->prepare(scene.load_stepping.nominal_step(0.));

    std::vector<std::string> lines = {
      std::to_string(forest.triangulation.n_global_active_cells()) + " cells, " +
      std::to_string(solid.dof_handler.n_dofs() / dim) + " nodes, " +
      std::to_string(solid.dof_handler.n_dofs()) + " unknowns"};
    const auto add = [&lines](const std::vector<std::string> &more) {
      lines.insert(lines.end(), more.begin(), more.end());
    };
    add(scene.without_effect);
    add(describe_bodies(scene, forest, solid));
    for (const std::string &text : forest.warnings())
      lines.push_back("warning: " + text);
    for (const std::string &text : doubtful_ties(problem->state().contact))
      lines.push_back("warning: " + text);
    add(adjusted);
    add(start);
    if (!problem->held_by_contact().empty())
      lines.push_back("held by contact alone: " + problem->held_by_contact());
    const CycleCounts *cycles = problem->cycle_counts();
    if (cycles != nullptr)
      add(describe_gaps(scene, forest, solid));
    lines.push_back(expected_cost(scene, solid, cycles));
    return lines;
  }
} // namespace Touchstone
