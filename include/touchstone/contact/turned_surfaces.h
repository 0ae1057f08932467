// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_turned_surfaces_h
#define touchstone_contact_turned_surfaces_h

#include <touchstone/contact/contact.h>

#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Pairs whose surfaces have turned farther than what is measured on them can follow
   * (doc/theory.md 4.6), each with place, size of the error and remedy, in words.
   *
   * With exact surfaces the arch over a face, from the facet to the exact surface, keeps the
   * direction of the reference state, equation (8); so does the distance that a tied pair is placed
   * with where its rows leave it to itself (ContactPair::leave_offsets()), whose forces pass it
   * without their moment. Both are rightly zero where nodes lie on each other.
   *
   * The surfaces must be those of the last step. Collective.
   */
  std::vector<std::string>
  turned_surfaces(const Contact &contact);
} // namespace Touchstone

#endif
