// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_contact_residuals_h
#define touchstone_contact_contact_residuals_h

#include <touchstone/algebra/vector.h>

namespace Touchstone
{
  class Contact;

  /**
   * @brief What the points between the slave nodes violate of the contact conditions, weighted for
   * the error of a force: the integral of lambda n.[z] + lambda_z g(u) over the faces in contact.
   *
   * @p u is the displacement of the last update, @p z the response of all bodies to something, with
   * contact as it is; lambda and lambda_z are their contact pressures, g is the gap and n.[z] how
   * far z closes it, both with the surfaces that gaps are measured to (doc/theory.md 11, equation
   * (32)). Tied pairs and contact of a body with itself are left out, as are faces of which a node
   * is not in contact. Force times length, or force if z has no unit. Collective. @param u, z Owned
   * dofs.
   */
  double
  contact_residuals(const Contact &contact, const Vector &u, const Vector &z);
} // namespace Touchstone

#endif
