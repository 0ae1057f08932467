// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_contact_checks_h
#define touchstone_contact_contact_checks_h

#include <string>
#include <vector>

namespace Touchstone
{
  class Contact;

  /** @brief Text on gaps and overlaps as the bodies are placed, a line per pair. Collective. */
  std::vector<std::string>
  start_report(const Contact &contact);

  /** @brief Contact in the state of the last update that rows of slave nodes and master faces
   * cannot describe, in words; empty if there is none. Collective. */
  std::string
  unresolved_contact(const Contact &contact);

  /** @brief The part of unresolved_contact() that overlaps show: edges that have passed through
   * each other, vertices and obstacles within slave faces. Collective. */
  std::string
  unresolved_overlap(const Contact &contact);

  /** @brief Whether a pair has a contact force that is far from normal to the slave surface, the
   * other part of unresolved_contact(). Collective. */
  bool
  has_oblique_force(const Contact &contact, const ContactPair &pair);
} // namespace Touchstone

#endif
