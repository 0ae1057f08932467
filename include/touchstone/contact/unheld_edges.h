// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_unheld_edges_h
#define touchstone_contact_unheld_edges_h

#include <touchstone/contact/contact.h>

#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Sharp edges of contact surfaces that lie in the other body of their pair, though the
   * pair carries a force: for each pair the deepest place with the remedy, in words.
   *
   * Rows of slave nodes do not hold an edge that passes between them, nor one beside which the pair
   * names the face on one side only (doc/theory.md 4.1). Left out are overlaps that are there from
   * the start, as wanted or by the height of arcs over facets, those that springs leave, and pairs
   * whose surfaces are not moved, that are tied or whose initial overlap is adjusted.
   *
   * The surfaces must be those of the last step. Collective.
   */
  std::vector<std::string>
  unheld_edges(const Contact &contact);
} // namespace Touchstone

#endif
