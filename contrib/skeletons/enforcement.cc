// SPDX-License-Identifier: LGPL-2.1-or-later
// An enforcement to start from: an augmented Lagrangian in its simplest form. Copy to
// source/contact/enforcement/NAME.cc and change what is marked TODO: 'set Enforcement = NAME'
// selects it, and nothing else need be edited.

#include <touchstone/contact/contact.h>
#include <touchstone/contact/enforcement/enforcement.h>
#include <touchstone/contact/enforcement/row_terms.h>
#include <touchstone/contact/friction/friction_response.h>

namespace Touchstone
{
  namespace
  {
    /** lambda <- lambda - epsilon g, merged with the Newton iteration. */
    class SimpleAugmentedLagrange : public Enforcement
    {
    public:
      explicit SimpleAugmentedLagrange(const ContactParameters &)
        : memory(*this, "simple augmented lagrange")
      {
      }

      std::vector<std::string>
      keys() const override
      {
        return {"Tangential factor"};
      }

    protected:
      void
      evaluate(const Contact &contact, const Vector &, const ConstraintGraph &) override
      {
        for (const ContactRow &row : contact.rows())
          {
            RowState &state = row_states[row];
            if (!state.active() || state.dropped())
              continue;
            // TODO: the force of a row at its present gap and slip. The active set
            // opens rows that pull, so lambda may be negative here.
            state.lambda = memory[row].lambda - epsilon(row) * row.gap;
            if (row.tied)
              {
                state.force  = memory[row].force - epsilon(row) * row.gap_vector;
                state.lambda = state.force * row.normal;
              }
            if (row.friction)
              regularise_friction(row, state); // springs; conditions: choose_friction()
            evaluate_force(row, state);        // force = lambda n + friction
            if (solved)
              memory[row] = {state.lambda, state.force};
          }
        solved = false;
      }

      void
      constrain(const Contact &contact, ConstraintGraph &graph, LinearSystem &system) override
      {
        RowTerms terms(system);
        for (const ContactRow &row : contact.rows())
          {
            RowState &state = row_states[row];
            start_row(state);
            for (const Condition &condition : row_conditions(row, state, system.keep_symmetric))
              {
                // Not eliminated, but known to the graph: it refuses what supports
                // decide already, and sees which bodies contact holds.
                if (!state.record(condition,
                                  graph.accept(condition, ConstraintGraph::Treatment::multiplier)))
                  continue;
                if (!condition.symmetric())
                  system.symmetric = false;
                // TODO: the condition's part in the linear system; its value is -g.
                // Where friction drags along, its force has a direction of its own.
                const dealii::Tensor<1, dim> direction = condition.force();
                const double lambda = row.tied ? memory[row].force * direction : memory[row].lambda;
                terms.add_load(row, (lambda + epsilon(row) * condition.value) * direction);
                terms.add_stiffness(row, epsilon(row) * direction, condition.motion_form());
              }
          }
        terms.finish(); // collective
      }

      void
      set_forces(const Contact &) override
      {
        // TODO: what the forces are made of, as unknowns of your own, comes with take().
        solved = true;
      }

      void
      adopted(const ContactRow &row) override
      {
        memory[row] = {row_states[row].lambda, row_states[row].force};
      }

    private:
      /** TODO: what a row remembers, with the fields that a checkpoint holds. It is committed
       * and rolled back with the step, and forgotten where the row opens. */
      struct LastForce
      {
        double                 lambda = 0.;
        dealii::Tensor<1, dim> force;

        template <class Self, class Visitor>
        static void
        visit_state(Self &self, Visitor &&visit)
        {
          visit(self.lambda);
          visit(self.force);
        }
      };
      Memory<LastForce> memory;
      bool              solved = false;

      /** Force per length, in proportion to the stiffness of a cell. */
      static double
      epsilon(const ContactRow &row)
      {
        return 10. * row.stiffness;
      }
    };

    const EnforcementRegistry::Entry<SimpleAugmentedLagrange>
      simple_augmented_lagrange("simple augmented lagrange",
                                "springs with a force that removes their penetration");
  } // namespace
} // namespace Touchstone
