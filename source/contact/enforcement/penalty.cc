#include <touchstone/contact/enforcement/enforcement.h>
#include <touchstone/contact/enforcement/row_terms.h>

#include <cmath>
#include <limits>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /**
     * Springs between slave node and master surface, lambda = lambda_k - epsilon g:
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
        : factor(factor)
      {
      }

      void
      begin_step() override
      {
        solved = false;
      }

      void
      recover(Contact &contact, const Vector &, const ConstraintGraph &) override
      {
        for (auto &pair_rows : contact.rows)
          for (ContactRow &row : pair_rows)
            {
              if (!row.active() || row.dropped())
                continue;
              if (solved && !row.friction && !by_gap(row))
                respond(row); // the force of the linear solve
              else
                evaluate(row);
              grant(row, solved);
            }
        solved = false;
      }

      void
      enforce(Contact &contact, ConstraintGraph &graph, LinearSystem &system) override
      {
        // The system starts from the forces after augmentation, the residual has
        // been judged with those before.
        Vector residual;
        if (system.keep_symmetric)
          {
            residual = system.rhs;
            contact.add_forces(residual);
          }
        for (auto &pair_rows : contact.rows)
          for (ContactRow &row : pair_rows)
            if (row.active() && row.friction)
              {
                const Tensor<1, dim> force  = row.force;
                const double         lambda = row.lambda;
                evaluate(row);
                row.force  = force;
                row.lambda = lambda;
                if (system.keep_symmetric)
                  lag_friction(row, balancing_force(row, residual, graph));
              }

        springs.clear();
        RowTerms terms(system);
        for (auto &pair_rows : contact.rows)
          for (ContactRow &row : pair_rows)
            for (const Condition &condition : start_row(row, system.keep_symmetric))
              {
                if (!row.take(condition,
                              graph.accept(condition, ConstraintGraph::Treatment::spring)))
                  continue;
                if (!condition.symmetric())
                  system.symmetric = false;
                // The force after the iteration is lambda_k - epsilon (g + dg),
                // and the condition's value is -g.
                const double         epsilon   = factor * row.stiffness;
                const Tensor<1, dim> direction = condition.force();
                const double         augmented =
                  row.tied ? row.augmented * direction : row.augmented_lambda;
                const double force = augmented + epsilon * condition.value;
                terms.add_load(row, force * direction);
                terms.add_stiffness(row, epsilon * direction, condition.motion_form());
                if (!by_gap(row))
                  springs.push_back({&row, condition, force, epsilon});
              }
        terms.finish();
      }

      void
      take(const LinearSolution &solution) override
      {
        std::vector<LinearForm> forms;
        for (const Spring &spring : springs)
          forms.push_back(by_unknowns(spring.condition.motion_form()));
        const std::vector<double> elongations = evaluate_forms(forms, solution.increment);
        for (std::size_t k = 0; k < springs.size(); ++k)
          springs[k].force -= springs[k].epsilon * elongations[k];
      }

      void
      update(Contact &) override
      {
        for (const Spring &spring : springs)
          spring.row->force = Tensor<1, dim>();
        for (const Spring &spring : springs)
          spring.row->force += spring.force * spring.condition.direction;
        for (const Spring &spring : springs)
          spring.row->lambda = spring.row->force * spring.row->normal;
        solved = true;
      }

      double
      round_off_squared(const Contact &contact, const double length) const override
      {
        double sum = 0.;
        for (const auto &pair_rows : contact.rows)
          for (const ContactRow &row : pair_rows)
            if (row.active() && by_gap(row))
              sum += std::pow(4. * std::numeric_limits<double>::epsilon() * length * factor *
                                row.stiffness,
                              2);
        return sum;
      }

    protected:
      /** Decide what gap the row may have, and whether its force is augmented;
       * @p solved says that the gap is the outcome of a solve, and not the
       * overlap that a step begins with. */
      virtual void
      grant(ContactRow &row, bool solved) const = 0;

      /** Whether the force of the row is that of its spring at the present gap, and not that
       * which the spring had in the last linear solve. */
      virtual bool
      by_gap(const ContactRow &) const
      {
        return true;
      }

      /** Decide what the friction of the row starts from; @p epsilon is the
       * stiffness of the normal spring. */
      virtual void
      choose_friction(ContactRow &row, double epsilon) const = 0;

    private:
      /** A condition that a spring meets: its force before a solve, then after it; its stiffness.
       */
      struct Spring
      {
        ContactRow *row;
        Condition   condition;
        double      force, epsilon;
      };

      const double        factor;
      std::vector<Spring> springs; // of rows that do not go by_gap()
      bool                solved = false;

      /**
       * The normal force that would balance the slave node: what the last linear
       * solution meant it to be. The spring itself turns the error of a gap that
       * normals and weights have changed under the linearisation into a force, and
       * friction lagged with that force would push the nodes along by it, to the next
       * such error: with stiff springs on warped faces for ever.
       */
      static double
      balancing_force(const ContactRow &row, const Vector &residual, const ConstraintGraph &graph)
      {
        Tensor<1, dim> rest;
        for (unsigned int d = 0; d < dim; ++d)
          rest[d] = residual(dim * row.slave + d);
        return row.lambda - graph.free_part(row.slave, rest) * row.normal;
      }

      /** Forces of an active row from its gap and slip. */
      void
      evaluate(ContactRow &row) const
      {
        const double epsilon = factor * row.stiffness;
        if (row.tied)
          {
            row.force  = row.augmented - epsilon * row.gap_vector;
            row.lambda = row.force * row.normal;
            return;
          }
        // With friction the force of a linear solve stays until the next one.
        if (!row.friction || by_gap(row))
          row.lambda = row.augmented_lambda - epsilon * row.gap;
        if (row.friction)
          choose_friction(row, epsilon);
        respond(row);
      }
    };



    class Penalty : public SpringEnforcement
    {
    public:
      explicit Penalty(const ContactParameters &parameters)
        : SpringEnforcement(100. * parameters.penalty_factor)
        , factor(100. * parameters.penalty_factor)
      {
      }

      /** Each row has a spring of its own. */
      double
      smallest_circle() const override
      {
        return 2.;
      }

    private:
      const double factor;

      void
      grant(ContactRow &row, bool) const override
      {
        if (by_gap(row))
          row.granted_gap = row.tied ? row.gap_vector.norm() : row.gap;
        else
          // After a change of the mesh springs begin with the force from before.
          row.granted_gap = (row.augmented_lambda - row.lambda) / (factor * row.stiffness);
      }

      /** Friction and stick go by the normal force. Before balance that of the gap is as wrong as
       * the gap times the stiffness of the spring: stiff springs would stick all rows at first,
       * and turn them by geometric stiffness, whatever the solution. */
      bool
      by_gap(const ContactRow &row) const override
      {
        return row.tied || !row.friction;
      }

      void
      choose_friction(ContactRow &row, double) const override
      {
        row.friction->regularise();
      }
    };

    class AugmentedLagrange : public SpringEnforcement
    {
    public:
      explicit AugmentedLagrange(const ContactParameters &parameters)
        : SpringEnforcement(20. * parameters.penalty_factor)
        , merged(parameters.augmentation == ContactParameters::Augmentation::merged)
      {
      }

      void
      balanced(Contact &contact) override
      {
        for (auto &pair_rows : contact.rows)
          for (ContactRow &row : pair_rows)
            augment(row);
      }

    private:
      const bool merged;

      void
      grant(ContactRow &row, const bool solved) const override
      {
        row.granted_gap = 0.;
        if (merged && solved)
          augment(row);
      }

      /** Without friction the force is that of the linearised gap. One of the gap itself would
       * turn the change of normals and contact points into forces, the larger the stiffer the
       * springs. */
      bool
      by_gap(const ContactRow &row) const override
      {
        return !merged || row.friction;
      }

      void
      choose_friction(ContactRow &row, const double epsilon) const override
      {
        FrictionState &f = *row.friction;
        if (!f.exact || f.shared)
          {
            f.regularise();
            return;
          }
        f.hold = f.carried = false;
        f.c                = epsilon;
        f.base             = row.augmented;
      }

      static void
      augment(ContactRow &row)
      {
        row.augmented        = row.tied ? row.force : row.force - row.lambda * row.normal;
        row.augmented_lambda = row.lambda;
      }
    };

    const EnforcementRegistry::Entry<Penalty>
      penalty("penalty", "springs; leaves a penetration of force over penalty");
    const EnforcementRegistry::Entry<AugmentedLagrange>
      augmented_lagrange("augmented lagrange",
                         "springs whose forces are augmented until gaps close");
  } // namespace
} // namespace Touchstone
