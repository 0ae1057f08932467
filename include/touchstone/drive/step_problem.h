// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_step_problem_h
#define touchstone_drive_step_problem_h

#include <touchstone/contact/contact.h>
#include <touchstone/drive/forcing_term.h>
#include <touchstone/drive/holding_springs.h>
#include <touchstone/drive/pretension.h>
#include <touchstone/drive/rigid_tools.h>
#include <touchstone/drive/step.h>
#include <touchstone/drive/step_system.h>
#include <touchstone/drive/strayed_bodies.h>
#include <touchstone/scene/scene.h>
#include <touchstone/solid/boundary_conditions.h>

#include <deal.II/base/timer.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief An implicit step: balance of all bodies under loads, contact and, if the time
   * integration has it, inertia at the end of one step, solved by Newton's method. */
  class StepProblem : public Step, public NonlinearProblem
  {
  public:
    StepProblem(const Scene &scene, const Forest &forest, Solid &solid, dealii::TimerOutput &timer);

    std::vector<std::string>
    start() override;
    unsigned int
    solve(double t, const NewtonParameters &parameters, const Newton::Observer &observer) override;
    double
    end_of_step(double t) const override;
    StepFindings
    findings() const override;
    StepDifficulty
    difficulty() const override;
    std::string
    held_by_contact() const override;
    double
    try_commit(double smallest_part) override;
    void
    rollback() override;

    std::string
    next_attempt() const override;
    StepState
    state() const override;
    std::string
    advice() const override;
    std::optional<Vector>
    support_response(const std::vector<bool>      &bodies,
                     const dealii::Tensor<1, dim> &direction) override;
    StepTransfer
    transfer() const override;
    void
    adopt(const StepTransfer &before, double t) override;
    void
    save(ArchiveWriter &archive) override;
    void
    load(const ArchiveReader &archive) override;

    void
    prepare(double t) override;

    /** @brief Coordinates as text, for messages; adding zero turns -0 into 0. */
    static std::string
    readable(const dealii::Point<dim> &x);

  private:
    /** @name Interface to Newton's method */
    /** @{ */
    NewtonState
    residual(unsigned int damping) override;
    void
    linearize() override;
    int
    solve() override;
    void
    update() override;
    void
    shorten(double fraction) override;
    /** @} */

    /** The last increment will not be shortened any more: free what that needs. */
    void
    forget_increment();

    /** Solve with bodies on springs against motions that next to nothing resists, which are made
     * softer, and taken away where they hold more than facets would. @param least See
     * Newton::solve(). @return the number of linear solves. */
    unsigned int
    solve_with_springs(const Newton &newton, const Newton::Observer &observer, unsigned int least);

    /** Of the balanced states that differ by a rigid motion which nothing resists, find the one
     * next to the start of the step. @return the number of linear solves. */
    unsigned int
    take_out_free_motion(const Newton &newton, const Newton::Observer &observer);

    /** Start a step to time @p t from the committed state. */
    void
    begin_step(double t);

    /** See findings(). */
    std::vector<std::string>
    check_loose_bodies() const;
    /** See findings(). Of springs that carry more than round-off. */
    std::vector<std::string>
    check_springs() const;
    /** See findings(). @throws UnresolvedContactFailure */
    void
    check_contact() const;
    /** @param points PointsInContact::n. */
    std::string
    remarks(unsigned int points) const;
    /** See difficulty(). */
    std::string
    worst_place() const;
    LinearSolverCounts
    linear_counts() const;
    unsigned int
    n_searches() const
    {
      return earlier_searches + contact.n_searches();
    }
    /** See save(). */
    void
    forget();

    const Scene         &scene;
    Solid               &solid;
    dealii::TimerOutput &timer;
    BoundaryConditions   boundary_conditions;
    Contact              contact;
    Pretension           pretension;
    RigidTools           tools;

    double time = 0., committed_time = 0.;
    /** Displacements, and forces on the nodes: of loads (external) and of stresses (internal);
     * applied: all but those of contact, as the time integration weighs them; unbalanced: their
     * sum with contact, before the reactions of supports are removed. */
    Vector u, committed_u, external, internal, applied, unbalanced;
    /** Of the last linear solve, in full; empty when it will not be shortened any more. */
    Vector                           solved_increment;
    std::unique_ptr<TimeIntegration> integration;
    std::unique_ptr<StepSystem>      system;
    /** All that has history of its own. */
    std::vector<Stateful *> parts;
    /** Fraction of the step after which the first gap closes, by the first guess of its end; 1 if
     * none does. */
    double touch         = 1.;
    bool   touch_unknown = false;
    /** @name State to which shorten() returns: the displacement before the last
     * update(), empty without one, and the fraction of the increment that left all cells
     * admissible */
    /** @{ */
    Vector before_increment;
    double admissible_part = 1.;
    /** @} */
    unsigned int assemblies = 0;
    /** Counts of the problems before changes of the mesh. */
    LinearSolverCounts earlier;
    unsigned int       earlier_searches = 0;
    /** Reference positions and pairs of rows of this rank, as (x, y, z, pair). */
    using RowPlaces = std::vector<std::array<double, dim + 1>>;
    /** Those that changed in the last residual(), and those that exchanged() what they touch in the
     * last of a few in which any did: what goes to and fro need not do so in each. */
    RowPlaces changed_rows, exchanged_rows;
    /** The step begins with what comes from another mesh. */
    bool new_mesh = false;
    /** The attempt at this step began with bodies where their supports move them. */
    bool guessed = false;
    /** Of all ranks, and since how many calls of residual(). */
    unsigned int exchanges = 0, exchanged_since = 0;
    /** Active rows of the committed state, by pair. */
    std::vector<unsigned int> committed_active;
    /** Scale of the forces that act, at present and the largest of all committed states; zero
     * where the forces are no more than round-off. */
    double force_scale = 0., largest_force_scale = 0.;
    /** NewtonState::residual of the present state. */
    double relative_residual = 0.;
    /** Diagonal of the box around all bodies, and the largest prescribed displacement that
     * the present state misses; length. */
    double         diameter = 0., missed = 0.;
    ForcingTerm    forcing_term;
    StrayedBodies  strayed;
    HoldingSprings springs;
    /** Norm of their forces, the same relative to the forces that act, and both as sums over the
     * nodes, while they do. */
    double spring_force = 0., spring_share = 0., sum_of_springs = 0., carried_by_springs = 0.;
    /** This attempt at the step is made without them. */
    bool without_springs = false;
    /** What the attempt after this one does, see next_attempt(). */
    bool
    changes_linearisation() const
    {
      return forcing_term.next_attempt_differs() && system->may_change_linearisation();
    }
    bool
    drops_springs() const
    {
      return !guessed && !changes_linearisation() && springs.act();
    }

    /** Magnitude of the coordinates, for their round-off. */
    double extent = 0.;

    /** @name Parts of residual() */
    /** @{ */
    /** Rows and prescribed displacements at u. */
    void
    update_geometry(NewtonState &state);
    /** The forces on the nodes, without those of contact. */
    void
    balance(Vector &without_contact);
    /** Residual, its scale and its round-off. */
    void
    judge_balance(const Vector &without_contact, NewtonState &state);
    /** What springs that hold bodies carry of the forces that act, 1 for all. Collective. */
    double
    sum_carried_by_springs(const Vector &contact_force) const;
    void
    update_active_set(unsigned int damping, NewtonState &state);
    /** @} */

    /** The cell that is farthest turned inside out at the displacement @p trial. Collective. */
    std::string
    inverted_place(const Vector &trial) const;
    /** Where a body is compressed so far that its law resists further compression no longer; empty
     * if there is no such point. Collective. */
    std::string
    unstable_place() const;
    /** The component of the mean displacement in this step that is largest, of each body that
     * contact alone holds. Collective. */
    std::string
    motion_of_loose_bodies() const;
    /** The pairs none of whose slave nodes faces a master, in words; empty if there is none.
     * Collective. */
    std::string
    pairs_without_partner() const;
    /** What positions far from the origin leave of gaps, in words; empty if that is enough.
     * Collective. */
    std::string
    far_from_origin() const;
    /** The obstacles of pairs in contact in whose corners nodes may touch several walls, in words.
     * Collective. */
    std::string
    inner_corners() const;
    /** Whether rows that change may have no solution, as their friction does not vanish with the
     * pressure; in words, empty if not. Collective. */
    std::string
    friction_without_pressure() const;
    /** Pairs in which slave nodes that supports hold stick, while the master does not follow them
     * all; in words, empty if there are none. Collective. */
    std::string
    stick_of_held_nodes() const;
    /** See worst_place(): rows that change in the way @p how, and where the first of them is; empty
     * if there are none. Collective. */
    std::string
    place_of_first(const RowPlaces &rows, const std::string &how) const;
    /** @throws ExcessiveIncrement */
    void
    check_increment() const;
    /** Remember what check_loose_bodies() compares with, after a commit. */
    void
    remember_contact();
    /** Over all ranks, by pair. */
    std::vector<unsigned int>
    active_rows() const;
    /** Those of them that are tied, or whose force is more than round-off. */
    std::vector<unsigned int>
    holding_rows() const;
    /** Commit the present state, which has these forces. */
    void
    keep(const StepForces &forces);
    /** See try_commit(). */
    double
    acceptable_part(const Energies &end) const;
    /** Of a static step: bodies have not stored many times more energy than loads can have
     * supplied.
     * @throws EnergyGain */
    void
    check_strain_energy(const Energies &end) const;
    /** Nothing but loads and the closing of overlaps does work on the bodies in this step: no
     * supports, obstacles or temperatures that change. Collective. */
    bool
    loads_alone_act() const;
    /** Call @p use with the forces at the end of the step. */
    void
    with_forces(const std::function<void(const StepForces &)> &use);
  };
} // namespace Touchstone

#endif
