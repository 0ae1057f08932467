// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_step_system_h
#define touchstone_drive_step_system_h

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/algebra/linear_solver.h>
#include <touchstone/contact/contact.h>
#include <touchstone/drive/holding_springs.h>
#include <touchstone/drive/time_integration.h>
#include <touchstone/scene/scene.h>
#include <touchstone/solid/boundary_conditions.h>
#include <touchstone/solid/rigid_body_modes.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The linear system of one Newton iteration of an implicit step, doc/theory.md 5:
   * stiffness of the time integration, prescribed displacements, conditions and springs of contact,
   * loads that follow the deformation, and a diagonal shift for bodies that nothing but contact
   * holds. Its conditions are also what the residual is projected with.
   *
   * Per iteration: prescribe(), assemble(), solve(), recover(). All functions are collective;
   * vectors are over the owned dofs.
   */
  class StepSystem
  {
  public:
    /** @brief What the system is made from; kept by reference. */
    struct Parts
    {
      const Scene              &scene;
      const Solid              &solid;
      const BoundaryConditions &boundary_conditions;
      Contact                  &contact;
      TimeIntegration          &integration;
    };

    /** @brief The state at which the system is linearised. */
    struct State
    {
      double time;
      /** Displacement, length. */
      const Vector &u;
      /** Forces on the nodes: all but those of contact as the time integration weighs them, and
       * their sum with contact, before reactions. */
      const Vector &applied, &unbalanced;
      /** Out-of-balance force relative to the forces that act, NewtonState::residual. */
      double residual;
      /** Relative residual to which the system is to be solved. */
      double tolerance;
      /** Frozen iterations of this step have gained too little (ForcingTerm::slow()). */
      bool slow;
      /** Hold bodies back, or are not attached. */
      HoldingSprings &springs;
    };

    /** The bodies' stiffness must have been assembled. */
    explicit StepSystem(const Parts &parts);

    /** @brief A step begins: forget which bodies needed stabilisation. */
    void
    begin_step();

    /** @brief Begin with the prescribed displacements at time @p t. @return the largest one that
     * @p u misses, length. */
    double
    prescribe(double t, const Vector &u);

    /** @brief Remove from nodal forces their part along prescribed directions, which supports
     * carry. */
    void
    remove_supported(Vector &force) const;

    /** @brief Set up the system. */
    void
    assemble(const State &state);

    /** @brief Solve it for the increment of displacements, length. @return iterations, -1 for a
     * direct solver. @throws LinearSolverFailure */
    int
    solve(Vector &increment);

    /** @brief Take the contact forces of the last solution. */
    void
    recover(const Vector &increment);

    /** @throws InputError for bodies, and for parts of bodies that are not connected with the rest,
     * that have no support and no contact pair. */
    void
    check_bodies_without_support(const Vector &u);

    /** @brief Whether attempts at a step that gain little go on with another linearisation than
     * they began with. */
    bool
    may_change_linearisation() const
    {
      return parts.scene.has_contact() && !begins_consistent() && !solver->symmetric_only() &&
             parts.scene.contact.linearisation != ContactParameters::Linearisation::frozen;
    }

    /** @brief Conditions accepted so far. */
    const ConstraintGraph &
    conditions() const
    {
      return graph;
    }

    LinearSolver &
    linear_solver() const
    {
      return *solver;
    }

    /** @brief Whether the linear solver applies the operator instead of factorising it: vectors are
     * a good part of the memory then. */
    bool
    applies_operator() const
    {
      return solver->applies_operator(size());
    }

    /** @brief The free motions that needed stabilisation in the last assemble(), in words. */
    const std::string &
    stabilised() const
    {
      return free_motions;
    }

    /** @brief The rigid motions that neither the conditions of the last assemble() nor friction
     * resist: a balanced state stays balanced in them. Static steps alone have any. Collective. */
    FreeMotion
    undetermined_motion() const;

    /** @brief The motions that supports leave free, in words, by check_bodies_without_support(). */
    const std::string &
    unsupported() const
    {
      return left_free.description;
    }

    /** @brief The bodies that supports leave a motion, by check_bodies_without_support(). */
    const std::set<unsigned int> &
    unsupported_bodies() const
    {
      return left_free.bodies;
    }

    /** @brief Parts of bodies that are not connected with the rest and that supports leave free, in
     * words, by check_bodies_without_support(). */
    const std::string &
    unsupported_parts() const
    {
      return free_parts;
    }

    /** @brief Bodies that were stabilised in this step because only contact holds them. */
    const std::set<unsigned int> &
    loose_bodies() const
    {
      return loose;
    }

    /** @brief Diameter of the smallest cell, length. */
    double
    smallest_cell() const
    {
      return length;
    }

  private:
    Parts                            parts;
    std::shared_ptr<LinearSolver>    solver;
    RigidBodyModes                   modes;
    ConstraintGraph                  graph;
    std::unique_ptr<LinearSystem>    system;
    std::unique_ptr<CondensedSystem> condensed;
    /** Solution of the dofs beyond the displacements: multipliers. */
    std::vector<double> extra;
    std::string         free_motions, free_parts;
    /** What holds the bodies of the last assemble(); empty if it leaves them no motion. */
    std::vector<Condition> holding;
    /** By supports alone. */
    FreeMotion             left_free;
    std::set<unsigned int> loose;
    /** Diameter of the smallest cell, length. */
    double length;

    void
    begin(const State &state);
    /** Whether contact is linearised consistently from the first iteration of a step on. */
    bool
    begins_consistent() const;
    /** Whether contact is linearised consistently here. */
    bool
    consistent(const State &state) const
    {
      return begins_consistent() || (state.slow && may_change_linearisation());
    }
    void
    add_load_stiffness(const State &state);
    /** All dofs that this rank refers to: those of its ghost layer, and those of contact terms. */
    dealii::IndexSet
    dofs_of_system() const;
    void
    constrain(const dealii::IndexSet &needed);
    void
    change_basis(const dealii::IndexSet &needed);
    /** See check_bodies_without_support(). @param held What supports hold. */
    void
    check_parts(const std::vector<Condition> &held);
    /** Let the springs act on what @p holding and friction resist a little. */
    void
    hold_loosely_held(const State &state, std::vector<Condition> holding);
    /** Stabilise bodies that nothing but contact holds. */
    void
    check_supports(const State &state);
    /** Whether this holds on all ranks. */
    bool
    everywhere(bool here) const;
    /** Number of dofs, as linear solvers decide by it. */
    int
    size() const
    {
      return static_cast<int>(parts.solid.dof_handler.n_dofs());
    }
  };
} // namespace Touchstone

#endif
