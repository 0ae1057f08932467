// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_narrow_contact_h
#define touchstone_contact_narrow_contact_h

#include <touchstone/base/end_findings.h>
#include <touchstone/contact/contact.h>

#include <set>
#include <string>

namespace Touchstone
{
  /**
   * @brief Pairs whose contact is so narrow that their slave faces do not resolve it, in words with
   * place and remedy (doc/theory.md 4.1).
   *
   * The surfaces overlap between slave nodes that carry a force. Let the overlap of face f be d_f,
   * and the stiffness of its material behind it E A_f/h_f. Where the forces sum d_f E A_f/h_f that
   * would take the overlaps away are several times those that the rows carry
   * (Tolerances::narrow_contact), the latter say little of the force. It is a failure where such an
   * overlap is deeper than a fifth of a slave face.
   *
   * Collective.
   */
  EndFindings
  narrow_contact(const Contact &contact);

  /** @brief Looks whether one of @p bodies, which nothing but contact holds, lies deeper than a
   * fifth of a slave face within what it touches, between nodes that carry a force: it tips over or
   * slides there, and how far depends on the mesh (doc/theory.md 4.1).
   * @return where, in words; empty if there is none. The same on all ranks. Collective. */
  std::string
  sunk_in(const Contact &contact, const std::set<unsigned int> &bodies);
} // namespace Touchstone

#endif
