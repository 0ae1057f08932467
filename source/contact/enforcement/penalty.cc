// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/enforcement/spring_enforcement.h>
#include <touchstone/contact/friction/friction_response.h>

// Penalty method (doc/theory.md 6): the force of a spring is that of its gap, or with friction that
// of the last linear solve, and the penetration that belongs to it is admitted.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    class Penalty : public SpringEnforcement
    {
    public:
      explicit Penalty(const ContactParameters &parameters)
        : SpringEnforcement(100. * parameters.penalty_factor)
        , factor(100. * parameters.penalty_factor)
        , rule{ImpulseRule::Method::bulk_springs, 0.1 * parameters.penalty_factor}
      {
      }

      std::vector<std::string>
      keys() const override
      {
        return {"Penalty factor", "Tangential factor"};
      }

      const ImpulseRule *
      impulse_rule() const override
      {
        return &rule;
      }

      /** No component of a unit normal exceeds this: cyclic rows are kept, for each has a spring
       * of its own and no system becomes singular. */
      double
      cycle_threshold() const override
      {
        return 2.;
      }

    private:
      const double      factor;
      const ImpulseRule rule;

      void
      admit_gap(const ContactRow &row, bool) override
      {
        RowState &state = row_states[row];
        if (by_gap(row))
          state.admissible_gap = row.tied ? row.gap_vector.norm() : row.gap;
        else
          // lambda / epsilon is the penetration that belongs to the force of the linear solve; what
          // the gap differs from it is judged. After a change of the mesh the springs begin with
          // the transferred force as augmentation.
          state.admissible_gap =
            (augmentation[row].lambda - state.lambda) / (factor * row.stiffness);
      }

      /** Friction depends on the normal force. Before equilibrium -epsilon g is wrong by the error
       * of the gap times epsilon: with stiff springs all rows would stick at first, and their
       * geometric stiffness would be too large (doc/theory.md 6.3, "Penalty with friction"). */
      bool
      by_gap(const ContactRow &row) const override
      {
        // Tied rows and those without friction: the present gap, others: the last linear solve.
        return row.tied || !row.friction;
      }

      void
      choose_formulation(const ContactRow &row, RowState &state, double) const override
      {
        regularise_friction(row, state);
      }
    };

    const EnforcementRegistry::Entry<Penalty>
      penalty("penalty", "springs; leaves a penetration of force over penalty");
  } // namespace
} // namespace Touchstone
