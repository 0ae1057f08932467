// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/enforcement/impulse_enforcement.h>

#include <deal.II/base/exceptions.h>

// The enforcements of explicit dynamics by name. They say how the impulses of a cycle are found;
// the sweeps themselves are in explicit/impulse_solver.cc.
namespace Touchstone
{
  using namespace dealii;

  // Reached only if an implicit step was made with impulses, which scene/combinations.cc refuses.
  void
  ImpulseEnforcement::evaluate(const Contact &, const Vector &, const ConstraintGraph &)
  {
    AssertThrow(false, ExcInternalError());
  }



  void
  ImpulseEnforcement::constrain(const Contact &, ConstraintGraph &, LinearSystem &)
  {
    AssertThrow(false, ExcInternalError());
  }



  void
  ImpulseEnforcement::set_forces(const Contact &)
  {
    AssertThrow(false, ExcInternalError());
  }



  namespace
  {
    /** Forward-increment Lagrange multipliers: Carpenter, Taylor and Katona (1991), Int. J. Numer.
     * Methods Engng 32. */
    class ForwardIncrement : public ImpulseEnforcement
    {
    public:
      explicit ForwardIncrement(const ContactParameters &)
      {
      }

      bool
      one_sweep() const override
      {
        return false;
      }
    };

    /** Zhong (1993), Finite Element Procedures for Contact-Impact Problems. */
    class DefenceNode : public ImpulseEnforcement
    {
    public:
      explicit DefenceNode(const ContactParameters &)
      {
      }

      bool
      one_sweep() const override
      {
        return true;
      }
    };

    const EnforcementRegistry::Entry<ForwardIncrement>
      forward_increment("forward increment",
                        "of explicit dynamics: the impulses after which no gap is negative at the "
                        "end of the cycle;");
    const EnforcementRegistry::Entry<DefenceNode>
      defence_node("defence node",
                   "of explicit dynamics: its first sweep alone, exact where no two rows share a "
                   "node.");
  } // namespace
} // namespace Touchstone
