// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_bodies_in_obstacles_h
#define touchstone_contact_bodies_in_obstacles_h

#include <touchstone/contact/contact.h>

#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Bodies that reach into an obstacle of one of their pairs with a face that no pair of
   * both names, in words with the deepest place and the remedy (doc/theory.md 4.1).
   *
   * Rows know nothing of such faces: a block of which only the upper side is named falls through
   * the ground. Their centres, which may lie on facets of a curved surface, count from a quarter of
   * the size of the cell on, nodes that are on no named face from a fiftieth on, unless they were
   * half as deep at the start. Collective.
   */
  std::vector<std::string>
  bodies_in_obstacles(const Contact &contact);
} // namespace Touchstone

#endif
