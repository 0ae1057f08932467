// An enforcement to start from: an augmented Lagrangian in its simplest form. Copy to
// source/contact/enforcement/NAME.cc and change what is marked TODO: 'set Enforcement = NAME'
// selects it, and nothing else need be edited.

#include <touchstone/contact/enforcement/enforcement.h>
#include <touchstone/contact/enforcement/row_terms.h>

namespace Touchstone
{
  namespace
  {
    /** lambda <- lambda - epsilon g, merged with the Newton iteration. */
    class SimpleAugmentedLagrange : public Enforcement
    {
    public:
      explicit SimpleAugmentedLagrange(const ContactParameters &)
      {
      }

      void
      recover(Contact &contact, const Vector &, const ConstraintGraph &) override
      {
        for (auto &pair_rows : contact.rows)
          for (ContactRow &row : pair_rows)
            {
              if (!row.active() || row.dropped())
                continue;
              // TODO: the force of a row at its present gap and slip. The active set
              // opens rows that pull, so lambda may be negative here.
              row.lambda = row.augmented_lambda - epsilon(row) * row.gap;
              if (row.tied)
                {
                  row.force  = row.augmented - epsilon(row) * row.gap_vector;
                  row.lambda = row.force * row.normal;
                }
              if (row.friction)
                row.friction->regularise(); // springs; conditions: choose_friction(row)
              respond(row);                 // force = lambda n + friction
              if (solved)
                {
                  row.augmented_lambda = row.lambda;
                  row.augmented        = row.force;
                }
            }
        solved = false;
      }

      void
      enforce(Contact &contact, ConstraintGraph &graph, LinearSystem &system) override
      {
        RowTerms terms(system);
        for (auto &pair_rows : contact.rows)
          for (ContactRow &row : pair_rows)
            for (const Condition &condition : start_row(row, system.keep_symmetric))
              {
                // Not eliminated, but known to the graph: it refuses what supports
                // decide already, and sees which bodies contact holds.
                if (!row.take(condition,
                              graph.accept(condition, ConstraintGraph::Treatment::multiplier)))
                  continue;
                if (!condition.symmetric())
                  system.symmetric = false;
                // TODO: the condition's part in the linear system; its value is -g.
                // Where friction drags along, its force has a direction of its own.
                const dealii::Tensor<1, dim> direction = condition.force();
                const double lambda = row.tied ? row.augmented * direction : row.augmented_lambda;
                terms.add_load(row, (lambda + epsilon(row) * condition.value) * direction);
                terms.add_stiffness(row, epsilon(row) * direction, condition.motion_form());
              }
        terms.finish(); // collective
      }

      void
      update(Contact &) override
      {
        // TODO: what the forces are made of, as unknowns of your own, comes with take().
        solved = true;
      }

    private:
      bool solved = false;

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
