// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_enforcement_impulse_enforcement_h
#define touchstone_contact_enforcement_impulse_enforcement_h

#include <touchstone/contact/enforcement/enforcement.h>

namespace Touchstone
{
  /**
   * @brief Contact of explicit dynamics alone: forces are found cycle by cycle as the rule says
   * (doc/explicit.md, section 9), and no linear system is solved: the functions of Newton's method
   * are not to be called.
   */
  class ImpulseEnforcement : public Enforcement
  {
  public:
    explicit ImpulseEnforcement(const ImpulseRule &rule)
      : rule(rule)
    {
    }

    bool
    solves_systems() const override
    {
      return false;
    }

    const ImpulseRule *
    impulse_rule() const override
    {
      return &rule;
    }

  protected:
    void
    evaluate(const Contact &, const Vector &, const ConstraintGraph &) override;
    void
    constrain(const Contact &, ConstraintGraph &, LinearSystem &) override;
    void
    set_forces(const Contact &) override;

  private:
    const ImpulseRule rule;
  };
} // namespace Touchstone

#endif
