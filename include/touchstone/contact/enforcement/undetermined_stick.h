// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_enforcement_undetermined_stick_h
#define touchstone_contact_enforcement_undetermined_stick_h

#include <vector>

namespace Touchstone
{
  class ConstraintGraph;
  class Contact;

  /**
   * @brief By index of the row, whether equilibrium does not determine its force of stick, so that
   * the elastic slip of its springs has to (doc/theory.md 6, "Stick at the edge of two obstacles"
   * and "Stick where few nodes are free").
   *
   * @param supports Holds the supports only. Collective.
   */
  std::vector<bool>
  undetermined_stick(const Contact &contact, const ConstraintGraph &supports);
} // namespace Touchstone

#endif
