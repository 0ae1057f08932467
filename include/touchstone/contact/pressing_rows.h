// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pressing_rows_h
#define touchstone_contact_pressing_rows_h

#include <touchstone/contact/row_state.h>

namespace Touchstone
{
  class Contact;

  /**
   * @brief Which rows press: those with a force that the balance of the step determines.
   *
   * The rows of a body that floats between others, touching both, have forces of the size of
   * round-off, or of the tolerance of an iterative solver. What depends on whether a node carries a
   * force must not depend on their signs.
   */
  class PressingRows
  {
  public:
    /** @brief Of which state. */
    enum class Of
    {
      present,
      committed
    };

    /** @brief Collective. */
    explicit PressingRows(const Contact &contact, Of of = Of::present);

    /** @brief Whether the row is active, with a normal force that is a pressure and none of those
     * that are too small, by the largest of the state and by the stiffness of the bodies. */
    bool
    contain(const ContactRow &row) const;

  private:
    const Contact &contact;
    const Of       of;
    /** Of any row in this state; force. */
    double largest = 0.;

    const RowState &
    state(const ContactRow &row) const;
  };
} // namespace Touchstone

#endif
