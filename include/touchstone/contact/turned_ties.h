// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_turned_ties_h
#define touchstone_contact_turned_ties_h

#include <touchstone/contact/contact.h>

#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Boundaries of small-strain bodies that are tied to obstacles or reference points which
   * have turned: a warning for each, with pair, angle and remedy.
   *
   * A tie moves its nodes by (R - 1) X, whose linear strain is not zero but 1 - cos(theta) in the
   * plane of the turn: nodes are drawn together, and stiffen what they are the end of. It is told
   * of where this is more than a tenth of the mean strain of the body (doc/theory.md 4.6).
   *
   * The rows must be those of the last step. Collective.
   */
  std::vector<std::string>
  turned_ties(const Contact &contact);
} // namespace Touchstone

#endif
