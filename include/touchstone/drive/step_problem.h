// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_step_problem_h
#define touchstone_drive_step_problem_h

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/algebra/linear_solver.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/enforcement/enforcement.h>
#include <touchstone/drive/forcing_term.h>
#include <touchstone/drive/step.h>
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
    StepFindings
    findings() const override;
    StepDifficulty
    difficulty() const override;
    double
    try_commit(double smallest_part) override;
    void
    rollback() override;
    StepState
    state() const override;
    StepTransfer
    transfer() const override;
    void
    adopt(const StepTransfer &before, double t) override;
    void
    save(ArchiveWriter &archive) override;
    void
    load(const ArchiveReader &archive) override;

    /** @brief Start a step to time @p t from the committed state. */
    void
    begin_step(double t);

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

    /** See findings(). */
    std::vector<std::string>
    check_loose_bodies() const;
    /** See findings(). @throws UnresolvedContactFailure */
    void
    check_contact() const;
    std::string
    remarks() const;
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

    const Scene                    &scene;
    Solid                          &solid;
    dealii::TimerOutput            &timer;
    BoundaryConditions              boundary_conditions;
    Contact                         contact;
    std::shared_ptr<LinearSolver>   solver;
    std::unique_ptr<RigidBodyModes> modes;

    double time = 0., committed_time = 0.;
    /** Displacements, and forces on the nodes: of loads (external) and of stresses (internal);
     * applied: all but those of contact, as the time integration weighs them; unbalanced: their
     * sum with contact, before the reactions of supports are removed. */
    Vector u, committed_u, external, internal, applied, unbalanced;
    /** Of the last linear solve: the increment after halving for admissible cells, and the full
     * one. */
    Vector                           increment, solved_increment;
    std::unique_ptr<TimeIntegration> integration;
    /** Fraction of the step after which the first gap closes, by the first guess of its end; 1 if
     * none does. */
    double touch         = 1.;
    bool   touch_unknown = false;
    /** @name State to which shorten() returns: the displacement before the last
     * update(), and the fraction of the increment that left all cells admissible */
    /** @{ */
    Vector before_increment;
    double admissible_part = 1.;
    /** @} */
    ConstraintGraph                  graph;
    std::unique_ptr<LinearSystem>    system;
    std::unique_ptr<CondensedSystem> condensed;
    std::vector<double>              extra;
    unsigned int                     assemblies = 0;
    /** Counts of the problems before changes of the mesh. */
    LinearSolverCounts earlier;
    unsigned int       earlier_searches = 0;
    std::string        stabilised;
    /** Reference positions and pairs of this rank's rows that changed in the last residual(), as
     * (x, y, z, pair). */
    std::vector<std::array<double, dim + 1>> changed_rows;
    /** Bodies that were stabilised in this step because only contact holds them. */
    std::set<unsigned int> loose_bodies;
    /** Of the committed state: active rows and the obstacle's motion, by pair. */
    std::vector<unsigned int>           committed_active;
    std::vector<dealii::Tensor<1, dim>> committed_shift;
    /** Scale of the forces that act, at present and the largest of all committed states; zero
     * where the forces are no more than round-off. */
    double force_scale = 0., largest_force_scale = 0.;
    /** Diagonal of the box around all bodies, and the largest prescribed displacement that
     * the present state misses; length. */
    double      diameter = 0., missed = 0.;
    ForcingTerm forcing_term;

    /** Length against which a missed prescribed displacement is measured. */
    double length = 1.;
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
    void
    update_active_set(unsigned int damping, NewtonState &state);
    /** @} */

    /** @name Parts of linearize() */
    /** @{ */
    void
    begin_system();
    void
    add_follower_pressure();
    /** All dofs that this rank refers to: those of its ghost layer, and those of contact terms. */
    dealii::IndexSet
    dofs_of_system() const;
    void
    constrain_system(const dealii::IndexSet &needed);
    void
    change_basis(const dealii::IndexSet &needed);
    /** Stabilise bodies that nothing but contact holds. */
    void
    check_supports();
    /** @} */
    /** Whether this holds on all ranks. */
    bool
    everywhere(bool here) const;
    /** See worst_place(); empty if no row changed. */
    std::string
    changing_place() const;
    /** @throws ExcessiveIncrement */
    void
    check_increment() const;
    /** @throws InputError for bodies that have no support and no contact pair. */
    void
    check_bodies_without_support();
    /** Remember what check_loose_bodies() compares with, after a commit. */
    void
    remember_contact();
    /** Over all ranks, by pair. */
    std::vector<unsigned int>
    active_rows() const;
    /** Motion of the obstacle of each pair since time 0; zero without one. Collective. */
    std::vector<dealii::Tensor<1, dim>>
    obstacle_shifts() const;
    /** Remove from nodal forces their part along prescribed directions, which supports carry. */
    void
    remove_supported(Vector &force) const;
    /** Commit the present state, which has these forces and energies. */
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
