// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/free_memory.h>
#include <touchstone/base/input_error.h>
#include <touchstone/base/interruption.h>
#include <touchstone/base/non_convergence.h>
#include <touchstone/contact/narrow_contact.h>
#include <touchstone/contact/turned_surfaces.h>
#include <touchstone/contact/turned_ties.h>
#include <touchstone/contact/unheld_edges.h>
#include <touchstone/drive/simulation.h>
#include <touchstone/solid/turned_bodies.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

// The steps of a run: each is made, committed or cut, until the end time is reached or a failure
// repeats itself. Steps that are to end where bodies meet are shortened (doc/time_integration.md).
// Cut or not, steps end where those of the input end: loads turn there, and a run that passed such
// a time over would be another one.
namespace Touchstone
{
  using namespace dealii;

  void
  Simulation::load_stepping()
  {
    const LoadSteppingParameters &plan = scene.load_stepping;
    const double                  end  = plan.end_time;
    // A resumed run starts with the position of its checkpoint; size zero stands for a run from the
    // beginning.
    Position at = start;
    if (at.size <= 0.)
      at.size = plan.nominal_step(0.);
    /**
     * Fraction of the step size that is made next, below 1 if the step is to end where bodies meet
     * ("Adapt steps" of doc/time_integration.md). It is not a cut: later steps have their full size
     * again.
     */
    double part = 1.;
    // The tolerance stands for the round-off of summing up step sizes.
    while (at.time < end * (1. - 1e-12))
      {
        // A step of the plan ends exactly at its end: neither beyond it, nor just before it, which
        // would leave a step of the size of round-off.
        const double stop_at = step_end(at.time), nominal = plan.nominal_step(at.time);
        at.size           = std::min(at.size, stop_at - at.time);
        const double next = problem->end_of_step(
          stop_at - at.time - part * at.size < 1e-9 * nominal ? stop_at : at.time + part * at.size);
        // Number of steps in all if none is cut from here on, for the display only.
        const unsigned int expected =
          at.step - 1 + static_cast<unsigned int>(std::ceil((stop_at - at.time) / at.size - 1e-9)) +
          static_cast<unsigned int>((plan.phase_end(at.time) - stop_at) / nominal + 0.5) +
          plan.steps_after_phase(at.time);
        progress.begin_step(at.step,
                            expected,
                            next,
                            plan.all_phases()[plan.phase_at(at.time)].name);
        try
          {
            part = make_step(at, next);
          }
        catch (const Interruption &signal)
          {
            problem->rollback();
            summary.interrupted       = true;
            const std::string earlier = earlier_checkpoint(at);
            stop(signal.what() + (" in step " + std::to_string(at.step)) + " to time " +
                   std::to_string(next) +
                   (earlier.empty() ? "; with --resume the run begins with this step again"
                                    : "; start it again: --resume would go on from " + earlier +
                                        ", which an earlier run has left in the folder"),
                 at);
            return;
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
    if (const std::string reason = judge_end(); !reason.empty())
      {
        stop(reason, at);
        return;
      }
    write_last_checkpoint(at);
    summary.converged = true;
  }



  std::string
  Simulation::judge_end()
  {
    if (const std::string reason =
          missed_pairs.failure(had_contact, scene.time_integration.dynamic());
        !reason.empty())
      return reason;
    if (const std::string reason = too_soft_springs(); !reason.empty())
      return reason;
    // Beside the preconditioner there is little room for what the checks make.
    give_back_free_memory();
    const StepState state = problem->state();
    // In explicit runs bodies may hit each other's edges at any moment.
    const bool        in_cycles = problem->cycle_counts() != nullptr;
    const EndFindings narrow    = in_cycles ? EndFindings() : narrow_contact(state.contact);
    if (!narrow.failure.empty())
      return narrow.failure;
    const auto tell = [this](const std::vector<std::string> &texts) {
      for (const std::string &text : texts)
        warnings.add(text);
    };
    const EndFindings bodies = turned_bodies(solid, state.ghosted_displacement());
    tell(bodies.warnings);
    if (!bodies.failure.empty())
      return bodies.failure;
    if (!in_cycles)
      {
        tell(unheld_edges(state.contact));
        tell(turned_ties(state.contact));
        const EndFindings surfaces = turned_surfaces(state.contact);
        tell(surfaces.warnings);
        if (!surfaces.failure.empty())
          return surfaces.failure;
      }
    tell(narrow.warnings);
    return "";
  }



  bool
  Simulation::keeps_step_ends() const
  {
    return !(scene.time_integration.dynamic() && scene.time_integration.adapts_to_impacts());
  }



  double
  Simulation::step_end(const double time) const
  {
    const LoadSteppingParameters &plan = scene.load_stepping;
    const double                  end  = plan.phase_end(time);
    if (!keeps_step_ends())
      return end;
    const std::vector<LoadPhase> phases = plan.all_phases();
    const unsigned int           phase  = plan.phase_at(time);
    const double                 begin  = phase == 0 ? 0. : phases[phase - 1].end_time;
    // The tolerance is that of summing up step sizes.
    const double n = 1. + std::floor((time - begin) / plan.nominal_step(time) + 1e-9);
    return n >= phases[phase].steps ? end : begin + (end - begin) * n / phases[phase].steps;
  }



  double
  Simulation::make_step(Position &at, const double next)
  {
    const LoadSteppingParameters &plan    = scene.load_stepping;
    const unsigned int            phase   = plan.phase_at(at.time);
    const double                  nominal = plan.nominal_step(at.time);
    const double                  length  = next - at.time;
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
                        !scene.has_contact() || cycles->seconds == 0.
                          ? 0.
                          : cycles->contact_seconds / cycles->seconds);
    else
      progress.end_step(newton);
    for (const std::string &text : findings.warnings)
      warnings.add(text);
    missed_pairs.end_step(findings.missed, warnings);
    record_step(at.step, at.time, length, newton, at.cuts, phase);
    log.check();
    summary.steps = at.step;
    ++at.step;
    // The difficulty is often local in time, and the size returns to the user's: a cut is undone
    // where a step of twice the size ends at a time at which it would have ended without any cut.
    const double twice = std::ldexp(nominal, 1 - static_cast<int>(at.cuts)),
                 left  = (step_end(at.time) - at.time) / twice;
    if (at.cuts > 0 && (!keeps_step_ends() || std::abs(left - std::round(left)) < 1e-6))
      --at.cuts;
    // A new phase begins with steps of its own.
    if (plan.phase_at(at.time) != phase)
      at.cuts = 0;
    at.size = std::ldexp(plan.nominal_step(at.time), -static_cast<int>(at.cuts));
    if (checkpoint_due(at))
      write_checkpoint(at);
    return 1.;
  }



  bool
  Simulation::cut_step(const NonConvergence &failure, Position &at, const double next)
  {
    if (const std::string how = problem->next_attempt();
        failure.shorter_step_may_help() && !how.empty())
      {
        const std::string reason = describe(failure, /*repeated=*/false);
        problem->rollback();
        progress.repeat_step(reason, how);
        return true;
      }
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
               ", cut " + std::to_string(at.cuts) + " times)" + lost_equilibrium(failure),
             {at.time, scene.load_stepping.nominal_step(at.time), at.step, 0});
        return false;
      }
    ++at.cuts;
    at.size *= 0.5;
    progress.cut_step(reason, at.size);
    return true;
  }



  std::string
  Simulation::lost_equilibrium(const NonConvergence &failure) const
  {
    // Bodies that friction holds until they snap, or that buckle, leave no static equilibrium
    // nearby. A block pushed along with a coefficient of 2 does so (doc/robustness.md). Failures
    // that name their cause say what else there is.
    if (scene.time_integration.dynamic() || summary.steps == 0 || failure.names_its_cause())
      return "";
    return ". Where all steps before went well there may be no static equilibrium to go on with, "
           "because a body starts to slide as a whole, snaps or buckles: with inertia "
           "('Time integration/Scheme = newmark') the run goes on, and what a load makes slide has an "
           "equilibrium under a prescribed displacement";
  }



  std::string
  Simulation::describe(const NonConvergence &failure, const bool repeated) const
  {
    std::string text = failure.what();
    if (failure.names_its_cause())
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
         << " active rows and " << last_state.changes << " that changed"
         << exchanges_in_words(last_state)
         << ", so that smaller steps cannot help. Other choices take other paths: "
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
} // namespace Touchstone
