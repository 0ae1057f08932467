// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_enforcement_enforcement_h
#define touchstone_contact_enforcement_enforcement_h

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/algebra/linear_system.h>
#include <touchstone/base/registry.h>
#include <touchstone/contact/contact_parameters.h>
#include <touchstone/contact/enforcement/cyclic_constraints.h>
#include <touchstone/contact/enforcement/impulse_rule.h>
#include <touchstone/contact/row_array.h>
#include <touchstone/contact/row_state.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace Touchstone
{
  class Contact;
  class RefusedConditions;

  /** @brief Solution of a linear system, and the system that it belongs to. */
  struct LinearSolution
  {
    /** The system, and the graph with its conditions. */
    const LinearSystem    &system;
    const ConstraintGraph &graph;
    /** Displacement increment of this rank's dofs, before it is shortened. */
    const Vector &increment;
    /** Extra dofs of this rank: multipliers. */
    const std::vector<double> &extra;
    /** Adds the forces on hanging nodes to the nodes that these follow. */
    std::function<void(Vector &)> condense;
  };

  /** @brief Outcome of an update of the active set, over all ranks. */
  struct ActiveSetUpdate
  {
    unsigned int active  = 0;
    unsigned int changes = 0;
    /** Whether rows have been judged at all: at high damping they are only where the conditions of
     * the present set are met. */
    bool judged = true;
    /** Identifies the set, to detect that it recurs. */
    std::uint64_t signature = 0;
    /** Largest |gap| of active and penetration of open rows, relative to the
     * size of the faces, times Enforcement::weight_of_gaps(). */
    double gap = 0.;
    /** Rows of this rank whose status has changed. */
    std::vector<const ContactRow *> changed;
    /** Rows of this rank that have exchanged() what they touch, and how many of all ranks. */
    std::vector<const ContactRow *> exchanged;
    unsigned int                    exchanges = 0;
  };

  /**
   * @brief Turns active rows into conditions and terms of the linear system, and its solution
   * into contact forces. Independent of the pairing that made a row. Registered by name.
   *
   * It owns the state of the rows, status and forces, and further history of each row
   * (Memory), and decides by the active set strategy which rows are active.
   *
   * In each Newton iteration: recover() with the prescribed displacements in the
   * graph, update_active_set(), enforce() and add_friction(), then the system is
   * solved, then take() and update(). A derived class implements the protected functions of
   * this cycle.
   */
  class Enforcement : public Stateful
  {
  public:
    Enforcement();

    /** @brief Begin with rows that have no partner yet. */
    void
    reinit(const ContactRows &rows);

    /** @brief The present and committed states of the rows. */
    const RowArray<RowState> &
    states() const
    {
      return row_states;
    }

    /** @brief Replace the present states. */
    void
    set_states(const RowArray<RowState> &states)
    {
      row_states = states;
    }

    /** @brief Set the present state of a row, of explicit steps: its force is the mean over the
     * time since the committed state. */
    void
    set_state(const ContactRow &row, const RowState &state)
    {
      row_states[row] = state;
    }

    /** @brief The pairings have been updated: rows find and lose their partners.
     * @param first The bodies are as they are placed: what touches starts in contact. */
    void
    update_partners(const ContactRows &rows, bool first);

    /** @brief Whether contact forces are dofs of the linear system (multipliers), which then is
     * not definite. */
    virtual bool
    uses_multipliers() const
    {
      return false;
    }

    /** @brief Keys of section 'Contact' that not all enforcements act on in implicit steps, and
     * this one does. Of explicit steps: ImpulseRule::keys(). */
    virtual std::vector<std::string>
    keys() const
    {
      return {};
    }

    /** @name The kinds of steps that it serves: one of them, or both */
    /** @{ */
    /** @brief Whether it serves implicit steps, in which linear systems are solved. */
    virtual bool
    solves_systems() const
    {
      return true;
    }

    /** @brief How it finds the forces of a cycle of explicit dynamics (doc/explicit.md, section
     * 9); null if it does not serve explicit steps. */
    virtual const ImpulseRule *
    impulse_rule() const
    {
      return nullptr;
    }
    /** @} */

    /** @brief A step begins, or begins again: no linear solve has come before. */
    virtual void
    begin_step();

    /**
     * @brief Bring the contact forces of the rows up to date before they are judged.
     * @param unbalanced External minus internal forces, without contact forces.
     * @param graph      Holds the prescribed displacements only.
     */
    void
    recover(const Contact &contact, const Vector &unbalanced, const ConstraintGraph &graph);

    /**
     * @brief Decide which rows are active: lambda - c g > 0.
     *
     * @param damping Damping level of the active set: 0 changes every row whose status is
     *                violated, 1 only those where it is violated most, 2 only one, more only one
     *                and not before the set is solved: this breaks cycles.
     * @param in_balance The forces are in balance.
     */
    ActiveSetUpdate
    update_active_set(const Contact &contact,
                      double         gap_tolerance,
                      unsigned int   damping,
                      bool           in_balance);

    /** @brief Add the conditions of active rows to the graph, and terms and multipliers to the
     * system, whose right-hand side holds no contact forces. Rows that are part of a cyclic
     * dependency between pairs are left out. Collective. */
    void
    enforce(const Contact &contact, ConstraintGraph &graph, LinearSystem &system);

    /** @brief Add the terms of friction and of changing normals and stencils to the system
     * (doc/theory.md 5 and 6.3). Collective. */
    void
    add_friction(const Contact &contact, LinearSystem &system);

    /** @brief The forces are in balance with the active set as it is; called
     * before convergence is judged by the gaps. */
    virtual void
    balanced(const Contact &)
    {
    }

    /** @brief Store the quantities of a solution from which set_forces() makes the contact forces:
     * multipliers, or forces of springs. Collective. */
    virtual void
    take(const LinearSolution & /*solution*/)
    {
    }

    /** @brief Set the forces of the rows to those of the last solution.
     * @param may_shorten shorten() may follow: keep what it returns to. */
    void
    update(const Contact &contact, bool may_shorten);

    /** @brief Take the part @p fraction of the change of forces that the last update() made.
     * The active set is again that of the last linear system. */
    void
    shorten(const Contact &contact, double fraction);

    /** @brief The last update() will not be shortened any more: free what it has kept. */
    void
    forget_update();

    /** @brief Begin with this status and force, after a change of the mesh. */
    void
    adopt(const ContactRow &row, ContactStatus status, const dealii::Tensor<1, dim> &force);

    /** @brief Force that the round-off of positions of magnitude @p length leads
     * to: the residual cannot fall below it. Of this rank's rows, squared. */
    virtual double
    round_off_squared(const ContactRows &, const double) const
    {
      return 0.;
    }

    /** @brief Force that the round-off of such positions makes of gaps with the stiffness of the
     * bodies: smaller forces are none. Of the active rows of this rank, squared. */
    double
    round_off_of_gaps_squared(const ContactRows &rows, double length) const;

    void
    commit() override;
    void
    rollback() override;
    void
    save(ArchiveWriter &archive) const override;
    void
    load(const ArchiveReader &archive) override;

  protected:
    /** @brief History of each row that a kind of enforcement needs, as a member of its class:
     * committed and rolled back, saved in checkpoints, and set to default values where a row has
     * no contact force. T as for RowArray. */
    template <class T>
    class Memory : public RowArray<T>
    {
    public:
      Memory(Enforcement &owner, const std::string &name)
        : RowArray<T>(name)
      {
        owner.arrays.push_back(this);
      }
      Memory(const Memory &) = delete;
    };

    /** @brief By what gaps are multiplied before Newton's method judges them: more than one where
     * an open gap leaves something out of a force. @param largest_force Of all rows, over stiffness
     * times size of each. */
    virtual double
    weight_of_gaps(double largest_force) const
    {
      (void)largest_force;
      return 1.;
    }

    /** @brief Evaluate the contact forces of the rows, by evaluate_force() where there may be
     * friction; see recover(). */
    virtual void
    evaluate(const Contact &contact, const Vector &unbalanced, const ConstraintGraph &graph) = 0;

    /** @brief See enforce(); start_row() and row_conditions() give the conditions of a row, and
     * RowState::record() notes what the graph has accepted. */
    virtual void
    constrain(const Contact &contact, ConstraintGraph &graph, LinearSystem &system) = 0;

    /** @brief Set the forces of the rows to those of the last solution; called again, with the
     * states as they were before, where a part of the increment is taken back. */
    virtual void
    set_forces(const Contact &contact) = 0;

    /** @brief The state of a row was set from outside, by adopt(): let the memory be that of a
     * row that begins with this force. */
    virtual void
    adopted(const ContactRow &)
    {
    }

    /** @brief Components of unit normals larger than this count in the search for cyclic
     * dependencies between pairs: by default those of constraints that are about linearly
     * dependent. */
    virtual double
    cycle_threshold() const
    {
      return 0.3;
    }

    /** @brief Record conditions of stick that the graph has refused, and whether springs can meet
     * them. Collective. */
    void
    record_refused_stick(const RefusedConditions &refused,
                         const Contact           &contact,
                         const ConstraintGraph   &graph);

    /** @brief No contact force of any kind in this row. */
    void
    clear(const ContactRow &row);

    RowArray<RowState> row_states;
    /** Of the last linear system. Stick that depends on itself in a cycle is met by springs, as if
     * the graph had refused it: where bodies meet around an edge that is not represented by all of
     * their meshes, it is not quite what the others say. */
    CyclicConstraints::Redundant redundant;

  private:
    /** The states and all memory. */
    std::vector<RowArrayBase *> arrays;
    /** Displacement and forces are those of a linear solution, and the active set has not been
     * updated since. */
    bool after_solve = false;

    void
    change_status(const ContactRow &row, ContactStatus status);
  };

  using EnforcementRegistry = Registry<Enforcement, const ContactParameters &>;
} // namespace Touchstone

#endif
