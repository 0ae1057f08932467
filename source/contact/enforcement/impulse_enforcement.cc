// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/enforcement/impulse_enforcement.h>

#include <deal.II/base/exceptions.h>

// The enforcements of explicit dynamics alone, by name. They say how the forces of a cycle are
// found; the sweeps themselves are in explicit/impulse_solver.cc, springs in
// explicit/impulse_springs.cc. 'penalty' and 'augmented lagrange' serve implicit steps, too.
namespace Touchstone
{
  using namespace dealii;

  // Reached only if an implicit step was made with impulses, which check_combinations() refuses.
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
        : ImpulseEnforcement({ImpulseRule::Method::projection})
      {
      }
    };

    /** Zhong (1993), Finite Element Procedures for Contact-Impact Problems. */
    class DefenceNode : public ImpulseEnforcement
    {
    public:
      explicit DefenceNode(const ContactParameters &)
        : ImpulseEnforcement({ImpulseRule::Method::one_sweep})
      {
      }
    };

    /** The stiffness from masses and step that crash codes have beside K A^2 / V, for bodies of
     * very different stiffness. */
    class SoftPenalty : public ImpulseEnforcement
    {
    public:
      explicit SoftPenalty(const ContactParameters &parameters)
        : ImpulseEnforcement({ImpulseRule::Method::mass_springs, 0.1 * parameters.penalty_factor})
      {
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
    const EnforcementRegistry::Entry<SoftPenalty>
      soft_penalty("soft penalty",
                   "of explicit dynamics: springs as stiff as the masses of the nodes and the "
                   "cycles allow.");
  } // namespace
} // namespace Touchstone
