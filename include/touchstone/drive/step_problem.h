#ifndef touchstone_drive_step_problem_h
#define touchstone_drive_step_problem_h

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/algebra/linear_solver.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/enforcement/enforcement.h>
#include <touchstone/drive/newton.h>
#include <touchstone/drive/time_integration.h>
#include <touchstone/scene/scene.h>
#include <touchstone/solid/boundary_conditions.h>
#include <touchstone/solid/rigid_body_modes.h>

#include <deal.II/base/timer.h>

#include <array>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief Balance of all bodies under loads, contact and, if the time integration has it,
   * inertia at the end of one step. */
  class StepProblem : public NonlinearProblem
  {
  public:
    StepProblem(const Scene &scene, const Forest &forest, Solid &solid, dealii::TimerOutput &timer);

    /** @brief Look at the bodies as they are placed. @return lines on gaps and
     * overlaps of the contact pairs. */
    std::vector<std::string>
    start();

    /** @brief Start a step to time @p t from the committed state. */
    void
    begin_step(double t);

    /** @brief Keep the present state: displacement and contact history. */
    void
    commit();

    /**
     * @brief commit(), if the energies at the end of the step allow it: always in
     * statics.
     * @param smallest_part A shorter part than this of the step is not worth it.
     * @return 1 if the state is kept; else the part of the step that is to be made
     * instead, up to where bodies meet.
     * @throws EnergyGain
     */
    double
    try_commit(double smallest_part);

    /** @brief Return to the committed state. */
    void
    rollback();

    /**
     * @brief Look at bodies that nothing but contact holds and that touch nothing in the
     * present state: statics does not know where they belong. Collective.
     * @return what to tell of those that have come off without going far.
     * @throws LostContact if one of them touched something in the committed state, and has
     * moved much farther than anything that could have pushed it: Newton has thrown it off.
     */
    std::vector<std::string>
    check_loose_bodies() const;

    /** @brief Look for contact that rows of slave nodes and master faces cannot describe: its
     * forces would be wrong. Collective. @throws UnresolvedContactFailure */
    void
    check_contact() const;

    /** @brief Where the present state is farthest from a solution: the contact row that
     * changes, or else the node that is farthest out of balance, with body, place and pair.
     * Collective. */
    std::string
    worst_place() const;

    NewtonState
    residual(unsigned int caution) override;
    void
    linearize() override;
    int
    solve() override;
    void
    update() override;
    void
    shorten(double fraction) override;

    /** @brief Displacement without ghosts, length. */
    const Vector &
    displacement() const
    {
      return u;
    }

    /** @brief Displacement with the ghosts of the mesh. */
    Vector
    ghosted_displacement() const;

    std::vector<Reaction>
    reactions() const;

    /** @brief Elastic energy of all bodies, force times length. */
    double
    strain_energy() const
    {
      return solid.strain_energy(u);
    }

    const TimeIntegration &
    time_integration() const
    {
      return *integration;
    }

    const Contact &
    contact_state() const
    {
      return contact;
    }

    /**
     * @brief What a change of the mesh carries over: displacement and contact of the
     * committed state, and of the present one, and what the time integration says of the
     * former, as fields over the unknowns. Collective.
     */
    std::vector<Vector>
    carry_over() const;

    /**
     * @brief Go on from fields like those of carry_over() on a new mesh, and the momenta
     * of the committed state on the old one: the step to time @p t will begin from the
     * committed state at time @p committed_time, and its first iteration at the other one.
     */
    void
    adopt(const std::vector<Vector>       &fields,
          const std::vector<BodyMomentum> &momenta,
          double                           committed_time,
          double                           t);

    /** @brief Drop what earlier solutions have left behind to speed up or judge later
     * ones, and is in no checkpoint: a run that writes one and a run that goes on from it
     * must take the same way. Collective. */
    void
    forget();

    /** @brief Put the committed state and all counts into a checkpoint. Collective. */
    void
    save(ArchiveWriter &archive) const;

    /** @brief Go on from save(); comes after start(). Collective. @throws ArchiveError */
    void
    load(const ArchiveReader &archive);

    /** @brief Count on from what another problem has counted. */
    void
    count_on(const StepProblem &before);

    LinearSolverCounts
    linear_counts() const;

    unsigned int
    n_assemblies() const
    {
      return assemblies;
    }

    unsigned int
    n_searches() const
    {
      return earlier_searches + contact.n_searches();
    }

    /** @brief Why the present step may not converge: bodies that nothing but
     * contact holds; empty if there are none. */
    std::string
    suspicion() const
    {
      return stabilised.empty()
               ? ""
               : "; held by contact alone, perhaps against no resistance: " + stabilised;
    }

    /** @brief What happened in the present step that the user should know: rows
     * dropped, bodies stabilised; empty if nothing. Collective. */
    std::string
    remarks() const;

  private:
    const Scene                    &scene;
    Solid                          &solid;
    dealii::TimerOutput            &timer;
    BoundaryConditions              boundary_conditions;
    Contact                         contact;
    std::shared_ptr<LinearSolver>   solver;
    std::unique_ptr<RigidBodyModes> modes;

    double time = 0., committed_time = 0.;
    /** Displacements, and forces on the nodes; applied are all but those of contact, as
     * the time integration weighs them. */
    Vector u, committed_u, external, internal, applied, unbalanced;
    /** Of the last linear solve: what was taken of it, and all. */
    Vector                           increment, solved_increment;
    std::unique_ptr<TimeIntegration> integration;
    /** Part of the step after which the first guess of its end has bodies meet. */
    double touch         = 1.;
    bool   touch_unknown = false;
    /** @name What shorten() goes back to: the displacement before the last
     * update(), and the part of the increment that left all cells admissible */
    /** @{ */
    Vector before_increment;
    double admissible_part = 1.;
    /** @} */
    ConstraintGraph                  graph;
    std::unique_ptr<LinearSystem>    system;
    std::unique_ptr<CondensedSystem> condensed;
    std::vector<double>              extra;
    unsigned int                     assemblies = 0;
    /** Of problems before a change of the mesh. */
    LinearSolverCounts earlier;
    unsigned int       earlier_searches = 0;
    std::string        stabilised;
    /** Reference positions and pairs of this rank's rows that changed in the last residual(), as
     * (x, y, z, pair). */
    std::vector<std::array<double, dim + 1>> changed_rows;
    /** Bodies that only contact holds, and how they can move. */
    std::set<unsigned int> loose_bodies;
    /** Of the committed state: active rows and the obstacle's motion, by pair. */
    std::vector<unsigned int>           committed_active;
    std::vector<dealii::Tensor<1, dim>> committed_shift;
    /** Forces that act, at present and the largest of all committed states; zero where they
     * are no more than round-off. */
    double force_scale = 0., largest_force_scale = 0.;
    /** Diagonal of the box around all bodies, and the largest prescribed displacement that
     * the present state misses; length. */
    double diameter = 0., missed = 0.;
    /** Relative residual that the next linear solve needs. */
    double linear_tolerance = 1e-3;
    /** The one before this increment, if nothing but the residual was left to be met. */
    double last_residual = 0.;
    /** In this step an increment with an unchanged active set has gained little. */
    bool slow = false;

    /** Length against which a missed prescribed displacement is measured. */
    double length = 1.;
    /** Magnitude of the coordinates, for their round-off. */
    double extent = 0.;

    void
    check_supports();
    /** See worst_place(); empty if no row changed. */
    std::string
    changing_place() const;
    /** @throws ExcessiveIncrement */
    void
    check_increment() const;
    /** Remember what check_loose_bodies() compares with, after a commit. */
    void
    remember_contact();
    /** Over all ranks, by pair. */
    std::vector<unsigned int>
    active_rows() const;
    /** Motion of the obstacle of each pair since time 0; zero without one. Collective. */
    std::vector<dealii::Tensor<1, dim>>
    obstacle_shifts() const;
    /** Take from the forces on nodes what their supports carry. */
    void
    remove_supported(Vector &force) const;
    /** Keep the present state, whose forces and energies these are. */
    void
    keep(const StepForces &forces, const Energies &end);
    /** See try_commit(). */
    double
    acceptable_part(const Energies &end) const;
    /** Call @p use with the forces at the end of the step. */
    void
    with_forces(const std::function<void(const StepForces &)> &use);
  };
} // namespace Touchstone

#endif
