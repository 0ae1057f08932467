// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_enforcement_exact_enforcement_h
#define touchstone_contact_enforcement_exact_enforcement_h

#include <touchstone/contact/enforcement/enforcement.h>

namespace Touchstone
{
  /**
   * @brief What enforcements have in common that meet the conditions of active rows exactly
   * and find the contact forces as the multipliers of these conditions.
   *
   * The forces are those of the last linear solve. The normal force follows the present
   * normal, friction in slip the present slip. Where a support or another pair determines
   * the tangential displacement of a slave node, a condition on it would be refused: stick
   * is then enforced on the master surface, by a spring whose force is augmented in each
   * iteration until it leaves no slip.
   * Alart and Curnier (1991), Comput. Methods Appl. Mech. Engng 92.
   */
  class ExactEnforcement : public Enforcement
  {
  public:
    void
    begin_step() override
    {
      solved = false;
    }

    void
    take(const LinearSolution &solution) override
    {
      forces = multipliers(accepted, solution);
    }

  protected:
    /** A condition of a row that the graph has accepted, its number there, how it is met, and the
     * normal of the row in the linear system. */
    struct Accepted
    {
      const ContactRow          *row;
      Condition                  condition;
      std::size_t                number;
      ConstraintGraph::Treatment treatment;
      dealii::Tensor<1, dim>     normal;
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

    /** @brief Make the forces of conditions that are met by multipliers unknowns of the system.
     * Collective. */
    static void
    add_multipliers(const std::vector<Accepted> &accepted, LinearSystem &system);

    /** @brief A last change of a condition before it is offered to the graph. */
    virtual void
    adjust(const ContactRow & /*row*/, Condition & /*condition*/) const
    {
    }

    /** @brief Conditions are about to be offered. Collective. */
    virtual void
    prepare(const Contact & /*contact*/, LinearSystem & /*system*/)
    {
    }

    /** @brief The forces of the accepted conditions, along their directions: those that are
     * unknowns, and zero. Collective. */
    virtual std::vector<double>
    multipliers(const std::vector<Accepted> &accepted, const LinearSolution &solution) const;

  private:
    /** Of the last system, and what its solution has made of them. */
    std::vector<Accepted> accepted;
    std::vector<double>   forces;
    /** A linear solve has come after the last evaluate(). */
    bool solved = false;
  };
} // namespace Touchstone

#endif
