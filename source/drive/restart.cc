// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/base/input_error.h>
#include <touchstone/drive/simulation.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>
#include <cmath>

/**
 * @file
 * Checkpoints: what is saved of the run, and how one resumes from it. The state of the bodies is
 * saved by the step (StepProblem::save) and by its Stateful parts.
 * A resumed run takes the same path as one that was not stopped: everything that is kept between
 * steps only to save time is dropped in both at every checkpoint.
 */

namespace Touchstone
{
  using namespace dealii;

  FoundCheckpoint
  Simulation::find_origin(const Scene &scene, const bool resume, const MPI_Comm communicator)
  {
    if (!resume)
      return {};
    // The newest complete checkpoint; incomplete ones, of a run that died while writing, are
    // skipped with a line in the log.
    FoundCheckpoint found = find_checkpoint(scene.output.directory, communicator);
    if (!found.checkpoint)
      {
        std::string text =
          "there is no complete checkpoint in the folder " + scene.output.directory;
        for (const std::string &line : found.skipped)
          text += "; " + line;
        throw InputError("command line",
                         "--resume",
                         "",
                         text,
                         "name the folder of the run that was stopped with --output, or run the "
                         "scene from its beginning, with \"Checkpoints/Steps between\" set");
      }
    return found;
  }



  bool
  Simulation::checkpoint_due(const Position &position) const
  {
    const CheckpointParameters &parameters = scene.checkpoints;
    const unsigned int          last_step  = position.step - 1;
    // The number of the step is that of the next one.
    if (parameters.steps_between > 0 && last_step % parameters.steps_between == 0)
      return true;
    // The clocks of the ranks differ, and writing is collective: rank 0 decides for all.
    return parameters.minutes_between > 0. &&
           Utilities::MPI::broadcast(
             communicator, since_checkpoint.wall_time() >= 60. * parameters.minutes_between, 0);
  }



  std::vector<std::pair<std::string, std::reference_wrapper<FileSeries>>>
  Simulation::picture_series()
  {
    return {{"volume", volume_output.series()},
            {"points", point_output.series()},
            {"contact", contact_output.series()},
            {"contact master", master_output.series()}};
  }



  std::vector<std::string>
  Simulation::written_lists()
  {
    std::vector<std::string> names;
    for (const auto &[name, series] : picture_series())
      if (!series.get().list().empty())
        names.push_back(series.get().list_name());
    return names;
  }



  void
  Simulation::write_checkpoint(const Position &position)
  {
    TimerOutput::Scope scope(timer, "output");
    // The running summary keeps counting from the start of this process; the checkpoint gets the
    // total time.
    RunSummary now = summary;
    now.seconds    = seconds_so_far();
    ArchiveWriter archive(solid.dof_handler);
    archive.put("position", position);
    archive.put("end time", scene.load_stepping.end_time);
    archive.put("nominal step size", scene.load_stepping.nominal_step(position.time));
    archive.put("summary", now);
    archive.put("warnings", warnings.list());
    archive.put("had contact", had_contact);
    archive.put("missed contact", missed_pairs);
    archive.put("mesh files", mesh_files);
    if (summary.motion)
      archive.put("motion", *summary.motion);
    archive.put("statistics", statistics.rows());
    archive.put("statistics csv", statistics.csv_rows());
    archive.put("probes", probes.histories());
    archive.put("quantities", statistics.memories());
    archive.put("last quantities", statistics.for_summary());
    archive.put("format of pictures", scene.output.format.word());
    for (const auto &[name, series] : picture_series())
      archive.put(name + " pictures", series.get().list());
    archive.put("last picture", last_vtu_step);
    archive.put("cycles", summary.cycles);
    archive.put("contact work", summary.contact_work);
    problem->save(archive);
    const std::string name = checkpoints.write(archive.piece(),
                                               position.step - 1,
                                               position.time,
                                               scene.complete_entries());
    log.line("  " + name + " is written");
    last_checkpoint = position.step;
    since_checkpoint.restart();
  }



  std::string
  Simulation::earlier_checkpoint(const Position &position) const
  {
    if (position.step > 1 || last_checkpoint == position.step)
      return "";
    const auto earlier = find_checkpoint(folder.path(""), communicator).checkpoint;
    return earlier && earlier->step > 0 ? earlier->name : "";
  }



  void
  Simulation::write_last_checkpoint(const Position &position)
  {
    // A run that a signal ends is to go on later, whether or not the user has thought of it. The
    // initial state takes the place of nothing: a run started by mistake where an earlier one has
    // left a checkpoint, and ended at once, must not cost it.
    if ((scene.checkpoints.active() || summary.interrupted) && last_checkpoint != position.step &&
        earlier_checkpoint(position).empty())
      write_checkpoint(position);
  }



  void
  Simulation::check_mesh_files(const ArchiveReader &archive) const
  {
    if (!archive.has("mesh files")) // not in checkpoints of earlier versions
      return;
    const auto before = archive.get<std::vector<std::string>>("mesh files");
    // Compared by fingerprint: a mesh file that has changed could have the same number of cells in
    // another order, and nodal fields would be assigned to the wrong nodes without any error.
    for (unsigned int b = 0; b < mesh_files.size(); ++b)
      // Checkpoints of earlier versions have none of obstacles, which were not made from files.
      if ((b < before.size() ? before[b] : "") != mesh_files[b])
        throw InputError(b < scene.bodies.size()
                           ? scene.bodies[b].section() + "/Geometry"
                           : scene.obstacles[b - scene.bodies.size()].section(),
                         "File",
                         "",
                         "the mesh file is not the one that the checkpoint was written with",
                         "restore it, or run the scene from its beginning without --resume");
  }



  bool
  Simulation::restore_mesh(ArchiveReader &archive)
  {
    // Adapted meshes are stored as the set of refined cells and made again from the initial mesh.
    const auto refined = archive.refined_cells(forest.first_level());
    if (!refined.empty())
      {
        // The problem refers to the dofs of the mesh it was made on: it has to go before the mesh
        // changes, and a new one is made for the refined mesh.
        problem.reset();
        forest.refine(refined);
        solid.reinit();
        volume_output.reinit();
        probes.reinit();
        problem = Step::make(scene, forest, solid, timer);
      }
    try
      {
        // Matches the saved nodes with those of this run, which may have another number of ranks.
        archive.connect(solid.dof_handler);
      }
    catch (const ArchiveError &error)
      {
        throw InputError("command line",
                         "--resume",
                         origin.checkpoint->name,
                         std::string("this checkpoint does not belong to the scene: ") +
                           error.what() + ", the scene has one of " +
                           std::to_string(forest.triangulation.n_global_active_cells()),
                         "restore mesh files that have changed, or run the scene from its "
                         "beginning without --resume");
      }
    return !refined.empty();
  }



  void
  Simulation::restore_results(ArchiveReader &archive)
  {
    // Counts of the mesh come from the present one.
    const RunSummary before = archive.get<RunSummary>("summary");
    summary.steps           = before.steps;
    summary.meshes          = before.meshes;
    summary.iterations      = before.iterations;
    summary.contact         = before.contact;
    summary.reactions       = before.reactions;
    summary.cells           = forest.triangulation.n_global_active_cells();
    summary.unknowns        = solid.dof_handler.n_dofs();
    earlier_seconds         = before.seconds;
    if (summary.motion)
      summary.motion = archive.get<Motion>("motion");

    // Checkpoints of earlier versions have no quantities but the table.
    const bool any_quantities = archive.has("quantities");
    statistics.restore(archive.get<TableHandler>("statistics"),
                       archive.has("statistics csv") ? archive.get<StatisticsCsv>("statistics csv")
                                                     : StatisticsCsv(),
                       any_quantities ? archive.get<Statistics::Memories>("quantities")
                                      : Statistics::Memories(),
                       any_quantities ? archive.get<std::vector<StepValue>>("last quantities")
                                      : std::vector<StepValue>());
    if (archive.has("probes"))
      probes.restore(archive.get<Probes::Histories>("probes"));
    // In another format a series begins anew; checkpoints of earlier versions know one format and
    // two series.
    if (scene.output.format.word() == (archive.has("format of pictures")
                                         ? archive.get<std::string>("format of pictures")
                                         : "vtu"))
      for (const auto &[name, series] : picture_series())
        if (archive.has(name + " pictures"))
          series.get().restore(archive.get<FileSeries::List>(name + " pictures"));
    last_vtu_step = archive.get<unsigned int>("last picture");
    if (archive.has("warnings")) // not in checkpoints of earlier versions
      {
        warnings.restore(archive.get<std::vector<std::string>>("warnings"));
        had_contact = archive.get<std::map<std::string, double>>("had contact");
      }
    if (archive.has("missed contact")) // not in checkpoints of earlier versions
      missed_pairs = archive.get<MissedPairs>("missed contact");
    if (archive.has("cycles")) // not in checkpoints of earlier versions
      summary.cycles = archive.get<std::uint64_t>("cycles");
    if (archive.has("contact work"))
      summary.contact_work = archive.get<ImpulseWork>("contact work");
  }



  std::vector<std::string>
  Simulation::resume()
  {
    const Checkpoint &checkpoint = *origin.checkpoint;
    ArchiveReader     archive([&checkpoint](const unsigned int i) { return checkpoint.piece(i); },
                          checkpoint.n_pieces);
    check_mesh_files(archive);
    const bool refined = restore_mesh(archive);
    problem->start();
    problem->load(archive);

    start = archive.get<Position>("position");
    // The size of the next step is that of the checkpoint, cut as it was. If the user has changed
    // the step size or the end time, the number of cuts is applied to the new nominal size.
    const double nominal = scene.load_stepping.nominal_step(start.time);
    if (nominal != archive.get<double>("nominal step size") ||
        scene.load_stepping.end_time != archive.get<double>("end time"))
      start.size = std::ldexp(nominal, -static_cast<int>(start.cuts));
    committed_time = start.time;
    progress.start_at(start.time);

    restore_results(archive);
    last_checkpoint = start.step;
    remove_earlier_run(start.step);

    std::vector<std::string> lines = origin.skipped;
    lines.push_back("goes on from " + checkpoint.name + ": step " + std::to_string(start.step - 1) +
                    " at time " + Utilities::to_string(start.time) + ", written on " +
                    std::to_string(checkpoint.n_pieces) + " rank(s)" +
                    (refined ? "; " + std::to_string(summary.cells) + " cells" : ""));
    lines.insert(lines.end(), changed_parameters.begin(), changed_parameters.end());
    return lines;
  }
} // namespace Touchstone
