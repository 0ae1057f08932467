// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/enforcement/exact_enforcement.h>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Contact forces are dofs of the saddle-point system
     * [K B^T; B 0] [du; -lambda] = [f; -g], doc/theory.md 6, which is indefinite: it needs a direct
     * solver with pivoting. */
    class LagrangeMultipliers : public ExactEnforcement
    {
    public:
      explicit LagrangeMultipliers(const ContactParameters &)
      {
      }

      bool
      uses_multipliers() const override
      {
        return true;
      }

    protected:
      ConstraintGraph::Treatment
      treatment(const ContactRow &) const override
      {
        return ConstraintGraph::Treatment::multiplier;
      }

      void
      prepare(const Contact &, LinearSystem &system) override
      {
        // The multipliers are dofs of the system even if its solver does not factorise; the input
        // check refuses such solvers, see uses_multipliers().
        system.takes_multipliers = true;
      }
    };

    const EnforcementRegistry::Entry<LagrangeMultipliers>
      lagrange_multipliers_entry("lagrange multipliers",
                                 "contact forces as unknowns; needs a direct solver");
  } // namespace
} // namespace Touchstone
