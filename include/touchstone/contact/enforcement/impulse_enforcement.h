// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_enforcement_impulse_enforcement_h
#define touchstone_contact_enforcement_impulse_enforcement_h

#include <touchstone/contact/enforcement/enforcement.h>

namespace Touchstone
{
  /**
   * @brief Contact of explicit dynamics: each cycle takes from the velocities what would let bodies
   * penetrate at its end, by impulses in the rows (doc/explicit.md, section 9).
   *
   * It holds what the impulses made of the rows; they are found by ImpulseContact, which asks
   * this object how. No linear system is solved: the functions of Newton's method are not to
   * be called.
   */
  class ImpulseEnforcement : public Enforcement
  {
  public:
    bool
    by_impulses() const override
    {
      return true;
    }

    /** @brief Whether the impulses of a cycle are those of a single sweep over the rows: what
     * rows that share nodes leave undone is done in the next cycle. */
    virtual bool
    one_sweep() const = 0;

    /** @brief Set the state of a row: its force is the mean over the time since the committed
     * state. */
    void
    set_state(const ContactRow &row, const RowState &state)
    {
      row_states[row] = state;
    }

  protected:
    void
    evaluate(const Contact &, const Vector &, const ConstraintGraph &) override;
    void
    constrain(const Contact &, ConstraintGraph &, LinearSystem &) override;
    void
    set_forces(const Contact &) override;
  };
} // namespace Touchstone

#endif
