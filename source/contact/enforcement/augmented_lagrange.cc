// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact.h>
#include <touchstone/contact/enforcement/spring_enforcement.h>
#include <touchstone/contact/friction/friction_response.h>

#include <algorithm>

// Augmented Lagrangian (doc/theory.md 6): springs whose forces are augmented until gaps close,
// after each linear solve or in an outer iteration.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    class AugmentedLagrange : public SpringEnforcement
    {
    public:
      explicit AugmentedLagrange(const ContactParameters &parameters)
        : SpringEnforcement(20. * parameters.penalty_factor)
        , merged(parameters.augmentation == ContactParameters::Augmentation::merged)
        , rule{ImpulseRule::Method::augmentation, parameters.penalty_factor}
      {
      }

      std::vector<std::string>
      keys() const override
      {
        return {"Penalty factor", "Augmentation"};
      }

      const ImpulseRule *
      impulse_rule() const override
      {
        return &rule;
      }

      void
      balanced(const Contact &contact) override
      {
        for (const ContactRow &row : contact.rows())
          augment(row);
      }

    private:
      const bool        merged;
      const ImpulseRule rule;

      bool
      stiffens() const override
      {
        return merged;
      }

      /** What an open gap leaves out of a force is its stiffness times the gap: small beside the
       * force, and not only beside the face (doc/theory.md 5, equation (13)). Gaps that positions
       * are not known to cannot be asked for. An outer loop has a sequence of such states, and ends
       * it by the gap alone. */
      double
      weight_of_gaps(const double largest_force) const override
      {
        constexpr double part_of_force = 10., most = 100.;
        return merged ? std::clamp(1. / (part_of_force * largest_force), 1., most) : 1.;
      }

      void
      admit_gap(const ContactRow &row, const bool solved) override
      {
        // The augmentation closes gaps, so none is admitted. Merged augmentation follows each
        // linear solve; the overlap with which a step begins must not become a force.
        row_states[row].admissible_gap = 0.;
        if (merged && solved)
          augment(row);
      }

      /** Merged, the force is that of the linearised gap and slip. One of the gap itself would turn
       * the change of normals and contact points into forces, the larger the stiffer the
       * springs; with friction these move nodes along the surface, change stick and slip, and the
       * iteration does not converge. */
      bool
      by_gap(const ContactRow &) const override
      {
        return !merged;
      }

      void
      choose_formulation(const ContactRow &row,
                         RowState         &state,
                         const double      epsilon) const override
      {
        // Merged: as with multipliers, but springs meet the conditions of stick.
        choose_friction(row, state);
        FrictionForce &f = *state.friction;
        if (merged || f.carried)
          return;
        // Augmented friction: no condition and no elastic slip, the base is the force of the last
        // augmentation (table in doc/theory.md 6.1).
        f.constrained = false;
        f.c           = epsilon;
        f.base        = augmentation[row].rest;
      }
    };

    const EnforcementRegistry::Entry<AugmentedLagrange>
      augmented_lagrange("augmented lagrange",
                         "springs whose forces are augmented until gaps close");
  } // namespace
} // namespace Touchstone
