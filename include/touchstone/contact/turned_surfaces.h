// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_turned_surfaces_h
#define touchstone_contact_turned_surfaces_h

#include <touchstone/contact/contact.h>

#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Tied pairs whose surfaces have turned farther than their rows can follow (doc/theory.md
   * 4.6), each with place, size of the error and remedy, in words.
   *
   * The distance that such a pair is placed with keeps the direction of the reference state where
   * its rows leave it to itself (ContactPair::leave_offsets()), and forces pass it without their
   * moment. It is zero where nodes lie on the other surface.
   *
   * The surfaces must be those of the last step. Collective.
   */
  std::vector<std::string>
  turned_surfaces(const Contact &contact);
} // namespace Touchstone

#endif
