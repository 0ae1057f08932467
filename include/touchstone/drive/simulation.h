// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_simulation_h
#define touchstone_drive_simulation_h

#include <touchstone/archive/checkpoints.h>
#include <touchstone/base/folder.h>
#include <touchstone/drive/refinement.h>
#include <touchstone/drive/repeated_failure.h>
#include <touchstone/drive/step_problem.h>
#include <touchstone/output/contact_output.h>
#include <touchstone/output/converged_step.h>
#include <touchstone/output/log.h>
#include <touchstone/output/point_output.h>
#include <touchstone/output/probes.h>
#include <touchstone/output/progress.h>
#include <touchstone/output/statistics.h>
#include <touchstone/output/summary.h>
#include <touchstone/output/volume_output.h>
#include <touchstone/output/warnings.h>
#include <touchstone/scene/scene.h>
#include <touchstone/verification/reference_solution.h>

#include <deal.II/base/timer.h>

#include <functional>
#include <iosfwd>

namespace Touchstone
{
  /** @brief A run of one scene: load steps, output, summary. */
  class Simulation
  {
  public:
    /**
     * @param folder_of_scene For mesh files with relative names.
     * @param terminal        Where progress is shown; null shows none.
     * @param resume          Go on from the newest checkpoint in the output folder.
     * @throws InputError, OutputError
     */
    Simulation(const Scene       &scene,
               const std::string &folder_of_scene,
               std::ostream      *terminal,
               MPI_Comm           communicator,
               bool               resume = false);

    /**
     * @brief Run all load steps and write all output.
     * @return what the run came to; its `converged` says whether every step did.
     * A step that cannot be made to converge ends the run with the last converged
     * state on disk.
     */
    RunSummary
    run();

    /** @brief Have @p observer called after each converged step, on all ranks, with the state
     * at its end. What it throws ends the run. */
    void
    after_step(std::function<void(const ConvergedStep &)> observer)
    {
      observers.push_back(std::move(observer));
    }

    /** @brief Comparison with the reference solution as text. */
    const std::vector<std::string> &
    comparison() const
    {
      return comparison_lines;
    }

    /** @brief Names of the .pvd or .xdmf files that the run has written. */
    std::vector<std::string>
    written_lists();

  private:
    const Scene                   &scene;
    const MPI_Comm                 communicator;
    const FoundCheckpoint          origin;
    const std::vector<std::string> changed_parameters;
    dealii::Timer                  wall;
    dealii::TimerOutput            timer;
    OutputFolder                   folder;
    Log                            log;
    Warnings                       warnings;
    Forest                         forest;
    /** What has become of surfaces that cross each other. */
    const std::vector<std::string>     adjusted;
    Solid                              solid;
    std::unique_ptr<Step>              problem;
    Refinement                         refinement;
    Progress                           progress;
    Statistics                         statistics;
    VolumeOutput                       volume_output;
    PointOutput                        point_output;
    Probes                             probes;
    ContactOutput                      contact_output, master_output;
    std::shared_ptr<ReferenceSolution> reference;
    Checkpoints                        checkpoints;
    RunSummary                         summary;
    std::vector<std::string>           comparison_lines;
    /** Those of after_step(). */
    std::vector<std::function<void(const ConvergedStep &)>> observers;
    /** By the names of pairs: the last time at which they had contact. */
    std::map<std::string, double> had_contact;
    /** What the rows of pairs have missed. */
    MissedPairs missed_pairs;
    /** Fingerprints of the mesh files, of bodies and then of obstacles. */
    std::vector<std::string> mesh_files;
    /** Of the last Newton iteration. */
    NewtonState     last_state;
    RepeatedFailure repeated_failure;
    /** Time of the last step that was kept. */
    double       committed_time = 0.;
    unsigned int last_vtu_step  = dealii::numbers::invalid_unsigned_int;

    /** @name Checkpoints, see source/drive/restart.cc */
    /** @{ */
    /** Where load stepping is between two steps: the time, the size and number of the next
     * step, and how often it has been cut. */
    struct Position
    {
      double       time = 0., size = 0.;
      unsigned int step = 1, cuts = 0;
    };
    dealii::Timer since_checkpoint;
    unsigned int  last_checkpoint = 0;
    /** Find the checkpoint to resume from, if @p resume. @throws InputError if there is none. */
    static FoundCheckpoint
    find_origin(const Scene &scene, bool resume, MPI_Comm communicator);
    /** Whether the scene asks for a checkpoint after the step that has ended. */
    bool
    checkpoint_due(const Position &position) const;
    void
    write_checkpoint(const Position &position);
    /** The checkpoint of an earlier run that is in the folder while the first step is made, "" if
     * there is none or the run has one of its own. Collective. */
    std::string
    earlier_checkpoint(const Position &position) const;
    /** Write a checkpoint after the last step, or of the initial state if there has been none,
     * unless there is one. */
    void
    write_last_checkpoint(const Position &position);
    /** @throws InputError if they have changed since the checkpoint was written. */
    void
    check_mesh_files(const ArchiveReader &archive) const;
    /** Refine the mesh as it was, and find the nodes of the checkpoint in it.
     * @return whether it has been refined.
     * @throws InputError if the nodes are others. */
    bool
    restore_mesh(ArchiveReader &archive);
    /** Summary, statistics, warnings and lists of output files of the run so far. */
    void
    restore_results(ArchiveReader &archive);
    /** Restore all that the checkpoint has. @return lines for the log. */
    std::vector<std::string>
    resume();
    /** Where load stepping begins. */
    Position start;
    /** Seconds that the run took before. */
    RunSummary::Seconds earlier_seconds;
    /** @} */

    /** Solve the step to @p time. @return Newton iterations. */
    unsigned int
    solve_step(double time);
    /** Warn of what the last estimate of errors leaves out. */
    void
    tell_of_estimate();
    /** Refine the mesh by the state at @p time, solve the step again, and so on.
     * @return Newton iterations. */
    unsigned int
    adapt(unsigned int step, double time);
    /** Energies, momenta and cycles of a converged step. */
    void
    record_energies(const std::vector<PairResult> &results, ConvergedStep &record);
    /** The state that the run starts from, before any balance. */
    void
    record_start();
    void
    record_step(unsigned int step,
                double       time,
                double       size,
                unsigned int newton,
                unsigned int cuts,
                unsigned int phase);
    void
    write_vtu(unsigned int step, double time);
    /** @brief Why the state at the end is no result; empty if it is one. Warns of what it leaves in
     * doubt. Collective. */
    std::string
    judge_end();
    /** @brief Why springs of contact are too soft for the result to mean anything; empty if they
     * are not. Warns where they are merely soft. Collective. */
    std::string
    too_soft_springs();
    /** @brief All series of files, by their names in checkpoints. */
    std::vector<std::pair<std::string, std::reference_wrapper<FileSeries>>>
    picture_series();

    /** Remove the summary of an earlier run and its result files of steps from @p first_step on,
     * which readers would take for those of this one. Collective. */
    void
    remove_earlier_run(unsigned int first_step);
    void
    load_stepping();
    /** Whether all steps of the input end where they do without cuts. Those that impacts shorten
     * move all later ones. */
    bool
    keeps_step_ends() const;
    /** Time that a step from @p time does not pass: the end of the step of the input in which it
     * lies, or else of the phase. */
    double
    step_end(double time) const;
    /**
     * Solve the step from @p at to the time @p next and keep it; @p at moves on. @return 1, or the
     * part of the step size that is to be made instead. @throws NonConvergence, InputError
     */
    double
    make_step(Position &at, double next);
    /** Halve the step size after a failure, or stop the run. @return whether it goes on. */
    bool
    cut_step(const NonConvergence &failure, Position &at, double next);
    /**
     * A step cannot be solved: write the last committed state, and a checkpoint if these are
     * active.
     */
    void
    stop(const std::string &reason, const Position &position);
    /**
     * The message of a failure, with the position of the model and whether smaller steps can help.
     */
    std::string
    describe(const NonConvergence &failure, bool repeated) const;
    /** That statics may have no equilibrium any more, as a sentence to follow the reason; empty
     * where the failure names another cause. */
    std::string
    lost_equilibrium(const NonConvergence &failure) const;
    /** Warn of pairs that had contact and have none at the end. */
    void
    check_lost_contact();
    /** Wall clock and processor time of the whole run. Collective. */
    RunSummary::Seconds
    seconds_so_far();
    void
    finish_summary();
    /** finish_summary(), and put it on disk. */
    void
    write_summary();
    /** Counts of work, not seconds, which depend on the machine. */
    void
    measure_balance();
  };

  /** @brief Build all that a run needs, without solving.
   * @return what it has understood, in lines: bodies and their boundaries, gaps of the contact
   * pairs, what contact alone holds, cycles of explicit dynamics, memory and time.
   * @throws InputError */
  std::vector<std::string>
  validate(const Scene &scene, const std::string &folder_of_scene, MPI_Comm communicator);
} // namespace Touchstone

#endif
