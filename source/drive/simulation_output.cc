// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/bodies_in_obstacles.h>
#include <touchstone/contact/contact_checks.h>
#include <touchstone/contact/contact_counts.h>
#include <touchstone/contact/overlapping_bodies.h>
#include <touchstone/contact/results.h>
#include <touchstone/drive/simulation.h>
#include <touchstone/output/resources.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

// What a run leaves on disk beside its statistics: VTU files, and at the end the summary with
// warnings, the comparison with an exact solution, counts of work and times.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    const std::string summary_file = "summary.json";
  }



  void
  Simulation::remove_earlier_run(const unsigned int first_step)
  {
    folder.remove_earlier([](const std::filesystem::directory_entry &entry) {
      return entry.path().filename() == summary_file;
    });
    for (const auto &[name, series] : picture_series())
      series.get().remove_earlier_run(first_step);
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
    const Vector reaction = solid.ghosted(problem->state().nodal_reactions());
    volume_output.write(u, rates.empty() ? nullptr : &velocity, step, time, &reaction);
    if (scene.output.point_values())
      point_output.write(u, step, time);
    const Contact &contact = problem->state().contact;
    auto           faces   = contact_faces(contact);
    auto           points  = contact_points(contact, u);
    problem->add_contact_results(faces, points);
    contact_output.write(faces, points, solid.owned, step, time);
    master_output.write(master_faces(contact), master_points(contact, u), solid.owned, step, time);
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
      for (const std::string &text : bodies_in_obstacles(state.contact))
        warnings.add(text);
    }
    finish_summary();
    summary.quantities = statistics.for_summary();
    summary.warnings   = warnings.list();
    if (summary.ranks > 1)
      log.line(summary.balance_line());
    TimerOutput::Scope scope(timer, "output");
    // Atomic: programs that wait for the file never read half of it.
    folder.write_file_atomically(summary_file, summary.to_json().print());
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
    // No warning: many scenes have pairs for what may touch.
    for (const auto &[pair, result] : summary.contact)
      if (result.active == 0 && had_contact.count(pair) == 0)
        log.line("contact pair '" + pair + "' had no contact in any step");
  }



  std::string
  Simulation::too_soft_springs()
  {
    // Explicit steps have a look of their own, at what presses on them.
    if (problem->cycle_counts() != nullptr)
      return "";
    // Springs that hold more energy than the bodies are what gives way; with a twentieth of it they
    // change forces by some percent. In dynamics energies say nothing at any one time.
    constexpr double most = 1., noticeable = 0.05, deepest = 1.;
    const auto      &energies = problem->state().time_integration.committed_energies();
    const double     bodies   = energies.strain + energies.plastic;
    for (const auto &[pair, left] : left_penetration(problem->state().contact))
      {
        const bool   statics = !scene.time_integration.dynamic();
        const double part    = statics ? left.energy / bodies : 0.;
        char         text[400];
        std::snprintf(text,
                      sizeof(text),
                      "contact pair '%s': springs leave a penetration of %.3g, %.2g times the size "
                      "of the slave faces%s. Take a larger \"Contact/Penalty factor\" (1 is the "
                      "automatic choice), or another \"Contact/Enforcement\"",
                      pair.c_str(),
                      left.length,
                      left.relative,
                      part > noticeable ? ", and hold energy beside that of the bodies" : "");
        if (part > most || left.relative > deepest)
          return text;
        if (part > noticeable)
          warnings.add(text);
      }
    return "";
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
        input.boundaries   = pair_boundaries(problem->state().contact);
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



  namespace
  {
    /** Cells that a rank of an explicit run computes: those that have a node of its own. */
    unsigned int
    computed_cells(const Solid &solid)
    {
      unsigned int       result = 0;
      std::vector<Index> dofs(solid.fe.n_dofs_per_cell());
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          ++result;
        else if (!cell->is_artificial())
          {
            cell->get_dof_indices(dofs);
            result += std::any_of(dofs.begin(), dofs.end(), [&](const Index dof) {
              return solid.owned.is_element(dof);
            });
          }
      return result;
    }
  } // namespace



  void
  Simulation::measure_balance()
  {
    // Counts of work per rank and their largest value over the mean: unlike seconds they do not
    // depend on the machine or its load.
    const ContactCounts                         work   = contact_counts(problem->state().contact);
    std::vector<std::pair<std::string, double>> counts = {
      {"cells", forest.triangulation.n_locally_owned_active_cells()},
      {"unknowns", solid.owned.n_elements()},
      {"neighbours", forest.triangulation.ghost_owners().size()},
      {"slave_rows", work.slave_rows},
      {"master_faces", work.master_faces},
      {"search_candidates", work.search.candidates},
      {"search_messages", work.search.messages},
      {"search_faces_sent", work.search.faces_sent}};
    if (scene.time_integration.runs_in_cycles())
      counts.insert(counts.begin() + 1, {"cells_computed", computed_cells(solid)});
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
} // namespace Touchstone
