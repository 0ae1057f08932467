// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_enforcement_spring_enforcement_h
#define touchstone_contact_enforcement_spring_enforcement_h

#include <touchstone/contact/enforcement/enforcement.h>
#include <touchstone/contact/enforcement/row_terms.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief Springs between slave node and master surface, lambda = lambda_k - epsilon g:
   * with lambda_k = 0 the penalty method, with lambda_k following the forces the
   * augmented Lagrangian. Without friction and with frozen normals the system stays
   * symmetric positive definite.
   * Alart and Curnier (1991), Comput. Methods Appl. Mech. Engng 92;
   * Laursen (2002), Computational Contact and Impact Mechanics.
   */
  class SpringEnforcement : public Enforcement
  {
  public:
    /** @param factor Spring stiffness over ContactRow::stiffness. */
    explicit SpringEnforcement(const double factor)
      : augmentation(*this, "augmentation")
      , factor(factor)
    {
    }

    void
    begin_step() override
    {
      Enforcement::begin_step();
      solved   = false;
      n_solves = 0;
    }

    void
    commit() override;

    void
    rollback() override;

    void
    save(ArchiveWriter &archive) const override;

    void
    load(const ArchiveReader &archive) override;

    void
    take(const LinearSolution &solution) override;

    double
    round_off_squared(const ContactRows &rows, double length) const override;

  protected:
    /** Force at the last augmentation: normal force, and the rest of it. */
    struct Augmentation
    {
      double                 lambda = 0.;
      dealii::Tensor<1, dim> rest;

      template <class Self, class Visitor>
      static void
      visit_state(Self &self, Visitor &&visit)
      {
        visit(self.lambda);
        visit(self.rest);
      }
    };
    Memory<Augmentation> augmentation;

    void
    evaluate(const Contact &contact, const Vector &, const ConstraintGraph &) override;

    void
    constrain(const Contact &contact, ConstraintGraph &graph, LinearSystem &system) override;

    void
    set_forces(const Contact &) override;

    void
    adopted(const ContactRow &row) override
    {
      augment(row);
    }

    /** Augmentation: the present force becomes lambda_k, to which the spring adds. */
    void
    augment(const ContactRow &row);

    /** Set the admissible gap of the row, and decide whether its force is augmented;
     * @p solved says that the gap is the outcome of a solve, and not the
     * overlap that a step begins with. */
    virtual void
    admit_gap(const ContactRow &row, bool solved) = 0;

    /** Whether the force of the row is that of its spring at the present gap, and not that
     * which the spring had in the last linear solve. */
    virtual bool
    by_gap(const ContactRow &) const
    {
      return true;
    }

    /** Whether the springs become stiffer where an iteration closes gaps too little. */
    virtual bool
    stiffens() const
    {
      return false;
    }

    /** Decide what the friction of the row starts from; @p epsilon is the
     * stiffness of the normal spring. */
    virtual void
    choose_formulation(const ContactRow &row, RowState &state, double epsilon) const = 0;

  private:
    /** A condition that a spring meets: its force before a solve, then after it; its stiffness;
     * the normal of the row in the linear system. */
    struct Spring
    {
      const ContactRow      *row;
      Condition              condition;
      double                 force, epsilon;
      dealii::Tensor<1, dim> normal;
    };

    const double        factor;
    std::vector<Spring> springs; // of rows that do not go by_gap()
    bool                solved = false;
    /** How many times stiffer the springs are than when the run began, and after the last step;
     * the linear solves of the step. */
    double       growth = 1., committed_growth = 1.;
    unsigned int n_solves = 0;

    /** Stiffness of the springs of a row, force per length. */
    double
    epsilon(const ContactRow &row) const
    {
      return growth * factor * row.stiffness;
    }

    /** Component of gap or slip along the condition of a spring, at present. */
    static double
    violation(const Spring &spring);

    /**
     * Stiffer springs from now on if the last linear solve has not closed the gaps
     * by a factor of four. The method of multipliers reduces them by 1/(1 + epsilon s), with s
     * the eigenvalues of B K^-1 B^T: slowly where the bodies are much stiffer than E A / h, as
     * near incompressibility, and not at all for small negative ones, where the tangent is
     * indefinite and only contact makes the state stable. The first solve of a step brings the
     * change of the load, and is not judged. Bertsekas (1982), Constrained Optimization and
     * Lagrange Multiplier Methods, section 2.2.
     */
    void
    stiffen(MPI_Comm communicator);

    /**
     * The normal force that would balance the slave node, as the last linear solution intended.
     * Normals and weights change during an increment, and the linearised gap misses that; times
     * epsilon this error is a large force. Friction lagged with it would move the nodes along the
     * surface, which causes the next error of this kind: with stiff springs on warped faces the
     * iteration would not converge (doc/theory.md 6.3, "Lagged friction").
     */
    double
    balancing_force(const ContactRow      &row,
                    const Vector          &residual,
                    const ConstraintGraph &graph) const;

    /** Normal force of a row: of its spring at the present gap, or, with friction and not
     * by_gap(), that of the last linear solve. */
    double
    normal_force(const ContactRow &row) const;

    /** Forces of an active row from its gap and slip. */
    void
    evaluate_row(const ContactRow &row, RowState &state);

    /** Meet a condition of a row by a spring. */
    void
    add_spring(const ContactRow &row, const Condition &condition, RowTerms &terms);
  };
} // namespace Touchstone

#endif
