// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_step_h
#define touchstone_drive_step_h

#include <touchstone/algebra/linear_solver.h>
#include <touchstone/contact/contact.h>
#include <touchstone/drive/missed_pairs.h>
#include <touchstone/drive/newton.h>
#include <touchstone/drive/rigid_tools.h>
#include <touchstone/drive/strayed_bodies.h>
#include <touchstone/drive/time_integration.h>
#include <touchstone/explicit/impulse_work.h>
#include <touchstone/scene/scene.h>
#include <touchstone/solid/boundary_conditions.h>

#include <deal.II/base/timer.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief Work of all steps so far. */
  struct StepCounts
  {
    LinearSolverCounts linear;
    unsigned int       assemblies = 0, searches = 0;
  };

  /** @brief The present state of a step, as results are made from it. */
  struct StepState
  {
    /** Displacement without ghosts, length. */
    const Vector          &displacement;
    const Contact         &contact;
    const CommittedMotion &time_integration;
    const Solid           &solid;
    StepCounts             counts;
    /** Shortening and tension of cuts with pretension, by pair: length, force. */
    std::map<std::string, std::pair<double, double>> pretension;
    /** Of obstacles that forces move, by name. */
    std::map<std::string, RigidToolResult> tools;
    /** Forces of the supports. */
    std::function<std::vector<Reaction>()> reactions;
    /** The same forces at the nodes, without ghosts; collective. */
    std::function<Vector()> nodal_reactions;

    /** @brief The displacement with the ghosts of the mesh. */
    Vector
    ghosted_displacement() const
    {
      return solid.ghosted(displacement);
    }
    /** @brief Elastic energy of all bodies, force times length. */
    double
    strain_energy() const
    {
      return solid.strain_energy(displacement);
    }
  };

  /** @brief The cycles of an output interval of explicit dynamics. */
  struct CycleCounts
  {
    unsigned int cycles = 0;
    /** The shortest cycle, and the stable step of the cell that decides it, time. */
    double smallest_step = 0., stable_step = 0.;
    /** That cell, as messages name it. */
    std::string cell;
    /** What contact had to do. */
    ImpulseWork contact;
    /** Of this rank; for the terminal alone. */
    double seconds = 0., contact_seconds = 0.;
  };

  /** @brief Remarks and warnings on a step that has been solved. */
  struct StepFindings
  {
    /** What happened that the user should know: rows dropped, bodies stabilised; empty if
     * nothing. */
    std::string remarks;
    /** Bodies that have come off what they touched without going far. */
    std::vector<std::string> warnings;
    /** What the rows of a pair have missed, by its name: overlaps that are not deep. */
    MissedPairs::Missed missed;
  };

  /** @brief Where a step that was not solved is farthest from a solution, and why it may be. */
  struct StepDifficulty
  {
    /** The contact row that changes, or else the node that is farthest out of balance, with
     * body, position and pair. */
    std::string position;
    /** Bodies that nothing but contact holds; empty if there are none. */
    std::string suspicion;
  };

  /** @brief What a change of the mesh carries over to the step on the new mesh. */
  struct StepTransfer
  {
    /** Displacement and contact of the committed state, and of the present one, and rates of
     * the former, as fields over the dofs. */
    std::vector<Vector> fields;
    /** Contact::friction_work(). */
    std::vector<double> friction_work;
    /** TimeIntegration::momenta_of_rates(). */
    std::vector<std::vector<BodyMomentum>> momenta;
    double                                 committed_time = 0.;
    Energies                               energies;
    double                                 largest_force_scale = 0.;
    StepCounts                             counts;
    RigidTools::Transfer                   tools;
    StrayedBodies                          strayed;
  };

  /**
   * @brief A step in time, or of the load, of all bodies: what Simulation and Refinement know
   * of it. An implicit step is solved by Newton's method (StepProblem).
   */
  class Step
  {
  public:
    virtual ~Step() = default;

    /** @brief The kind of step that the scene defines. Collective. */
    static std::unique_ptr<Step>
    make(const Scene &scene, const Forest &forest, Solid &solid, dealii::TimerOutput &timer);

    /**
     * @brief Initialise the state at time 0 and evaluate the initial contact. @return lines on gaps
     * and overlaps of the contact pairs. @throws InputError if a body has no support.
     */
    virtual std::vector<std::string>
    start() = 0;

    /** @brief Where a step that is to end at time @p t must end at the latest, for what is known
     * before it is solved. Collective. */
    virtual double
    end_of_step(const double t) const
    {
      return t;
    }

    /** @brief Go from the committed state to time @p t, without keeping it. @return the number of
     * iterations. @throws NonConvergence */
    virtual unsigned int
    solve(double t, const NewtonParameters &parameters, const Newton::Observer &observer) = 0;

    /** @brief Begin a step to time @p t and set up its first equations without solving them: this
     * evaluates meshes, initial gaps and formulas, and finds bodies that nothing holds. @throws
     * InputError */
    virtual void
    prepare(double t) = 0;

    /**
     * @brief Remarks and warnings on the present state. Collective.
     * @throws LostContact if a body that nothing but contact holds has moved much farther than
     * anything that could have pushed it: Newton's method has thrown it off.
     * @throws UnresolvedContactFailure for contact that rows of slave nodes and master faces cannot
     * describe: its forces would be wrong.
     */
    virtual StepFindings
    findings() const = 0;

    /** @brief Why the present step may not be solved. Collective. */
    virtual StepDifficulty
    difficulty() const = 0;

    /**
     * @brief Keep the present state, displacement and contact history, if the energies at the
     * end of the step allow it: always in statics.
     * @param smallest_part A shorter part than this of the step is not worth it; above 1 the
     *                      state is kept whatever its energies.
     * @return 1 if the state is kept; else the part of the step that is to be made
     * instead, up to where bodies meet.
     * @throws EnergyGain
     */
    virtual double
    try_commit(double smallest_part) = 0;

    /** @brief Return to the committed state. */
    virtual void
    rollback() = 0;

    /** @brief How the next attempt goes another way, in words, so that the one that has failed may
     * succeed with the same step size; empty: it would be the same. To be asked before rollback().
     */
    virtual std::string
    next_attempt() const
    {
      return "";
    }

    virtual StepState
    state() const = 0;

    /** @brief The displacement by which all bodies respond to a unit motion along @p direction of
     * the supports of those @p bodies that are marked, and of the ground of their springs, contact
     * as it is in the present state; no unit. The error of a contact force is weighted with it
     * (ForceEstimate). Nothing for steps that are not solved by iterations, in dynamics, for
     * bodies that are not linear, and while forces draw bolts. Collective. */
    virtual std::optional<Vector>
    support_response(const std::vector<bool> & /*bodies*/,
                     const dealii::Tensor<1, dim> & /*direction*/)
    {
      return std::nullopt;
    }

    /** @brief The rigid motions that supports leave free, so that contact alone resists them, as a
     * sentence; empty if there are none, or if inertia resists them. Known after start(). */
    virtual std::string
    held_by_contact() const
    {
      return "";
    }

    /** @brief The cycles of the present step; null for steps that are solved by iterations. */
    virtual const CycleCounts *
    cycle_counts() const
    {
      return nullptr;
    }

    /** @brief Add results of contact that belongs to no pair: of general contact. Its number is the
     * one after those of all pairs. */
    virtual void
    add_contact_results(std::vector<ContactFace> & /*faces*/,
                        std::vector<ContactPoint> & /*points*/) const
    {
    }

    /** @brief What to try if a run cannot go on, as a sentence. */
    virtual std::string
    advice() const = 0;

    /** @brief What a change of the mesh carries over. Collective. */
    virtual StepTransfer
    transfer() const = 0;

    /**
     * @brief Continue from a transfer() whose fields have been taken to the new mesh; comes after
     * start(): the step to time @p t will begin from the committed state, and its first
     * iteration at the present one. Collective.
     */
    virtual void
    adopt(const StepTransfer &before, double t) = 0;

    /** @brief Put the committed state and all counts into a checkpoint. Drops what earlier
     * solutions have left behind to speed up or judge later ones, and is in no checkpoint: a run
     * that writes one and a run that resumes from it must take the same path. Collective. */
    virtual void
    save(ArchiveWriter &archive) = 0;

    /** @brief Resume from save(); comes after start(). Collective. @throws ArchiveError */
    virtual void
    load(const ArchiveReader &archive) = 0;

    /** @brief Keep the present state in any case. */
    void
    commit()
    {
      try_commit(2.);
    }
  };
} // namespace Touchstone

#endif
