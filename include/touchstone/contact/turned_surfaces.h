// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_turned_surfaces_h
#define touchstone_contact_turned_surfaces_h

#include <touchstone/base/end_findings.h>
#include <touchstone/contact/contact.h>

namespace Touchstone
{
  /**
   * @brief Pairs whose surfaces have turned farther than their rows can follow, with place, size of
   * the error and remedy.
   *
   * The distance that a tied pair is placed with keeps the direction of the reference state where
   * its rows leave it to itself (ContactPair::leave_offsets()), and forces pass it without their
   * moment (doc/theory.md 4.6). It is zero where nodes lie on the other surface.
   *
   * With small sliding normals are those of the reference state. Where the slave surface turns by
   * theta a force along them has cos(theta) of itself along the present one: told of where 1 -
   * cos(theta) is more than 1e-3 in the mean over the forces of a pair between bodies, and a
   * failure from 0.1 on (26 degrees).
   *
   * The surfaces must be those of the last step. Collective.
   */
  EndFindings
  turned_surfaces(const Contact &contact);
} // namespace Touchstone

#endif
