// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_enforcement_exact_enforcement_h
#define touchstone_contact_enforcement_exact_enforcement_h

#include <touchstone/contact/enforcement/enforcement.h>
#include <touchstone/contact/enforcement/refused_conditions.h>
#include <touchstone/contact/enforcement/row_terms.h>

namespace Touchstone
{
  /**
   * @brief Common part of enforcements that satisfy the conditions of active rows exactly and
   * determine the contact forces as the multipliers of these conditions (doc/theory.md 6).
   *
   * The forces are those of the last linear solve. The normal force follows the present
   * normal, friction in slip the present slip. Where a support or another pair determines
   * the tangential displacement of a slave node, the graph refuses a condition on it: stick
   * is then enforced on the master surface, by a spring whose force is augmented in each
   * iteration until no slip is left.
   * Other conditions that the graph refuses have such springs as well, see RefusedConditions.
   * Alart and Curnier (1991), Comput. Methods Appl. Mech. Engng 92.
   */
  class ExactEnforcement : public Enforcement
  {
  public:
    void
    begin_step() override
    {
      Enforcement::begin_step();
      solved = false;
    }

    void
    take(const LinearSolution &solution) override
    {
      forces = multipliers(accepted, solution);
      take_springs(solution);
    }

  protected:
    /** A condition of a row that the graph has accepted, its number there, how it is met, and the
     * normal of the row in the linear system; or one that it has refused and that a spring meets,
     * with its force before the solve. */
    struct Accepted
    {
      const ContactRow          *row;
      Condition                  condition;
      std::size_t                number;
      ConstraintGraph::Treatment treatment;
      dealii::Tensor<1, dim>     normal;
      double                     force = 0.;
    };

    void
    evaluate(const Contact         &contact,
             const Vector          &unbalanced,
             const ConstraintGraph &graph) override;

    void
    constrain(const Contact &contact, ConstraintGraph &graph, LinearSystem &system) override;

    void
    set_forces(const Contact &contact) override;

    /** @brief How the conditions of a row are met. */
    virtual ConstraintGraph::Treatment
    treatment(const ContactRow &row) const = 0;

    /** @brief Add a dof to the system for the force of each condition that is enforced by a
     * multiplier. Collective. */
    static void
    add_multipliers(const std::vector<Accepted> &accepted, LinearSystem &system);

    /** @brief A last change of a condition before it is added to the graph. */
    virtual void
    adjust(const ContactRow & /*row*/, Condition & /*condition*/) const
    {
    }

    /** @brief Called before conditions are added to the graph. Collective. */
    virtual void
    prepare(const Contact & /*contact*/, LinearSystem & /*system*/)
    {
    }

    /** @brief The forces of the accepted conditions, along their directions: here those that are
     * multipliers in the system, and zero for others. Collective. */
    virtual std::vector<double>
    multipliers(const std::vector<Accepted> &accepted, const LinearSolution &solution) const;

  private:
    /** Accepted conditions of the last system, and their forces by its solution. */
    std::vector<Accepted> accepted;
    std::vector<double>   forces;
    /** Any rank has conditions that springs meet. */
    bool has_springs = false;
    /** A linear solve has come after the last evaluate(). */
    bool solved = false;

    /** Meet what the graph has refused by springs, where that can be. Collective. */
    void
    add_springs(const Contact           &contact,
                const RefusedConditions &refused,
                ConstraintGraph         &graph,
                LinearSystem            &system);

    /** Tell the springs of rows what gaps they have left. */
    void
    find_gaps_of_springs();

    /** The forces of springs after a solve. Collective. */
    void
    take_springs(const LinearSolution &solution);
  };
} // namespace Touchstone

#endif
