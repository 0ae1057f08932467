// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_undetermined_forces_h
#define touchstone_contact_undetermined_forces_h

#include <touchstone/contact/contact.h>

namespace Touchstone
{
  /**
   * @brief Choose, of all forces of tied and sticking rows that are in balance, those that continue
   * the tractions beside an edge where nodes of several bodies lie on each other (doc/theory.md 6,
   * "Forces that rows do not determine").
   *
   * A force that goes around such an edge from node to node and back changes nothing in balance,
   * and how enforcements divide it is arbitrary: the one that has been left out since others say
   * the same has none. Changes the forces of rows alone, at the end of a step. Collective.
   */
  void
  divide_undetermined_forces(Contact &contact);
} // namespace Touchstone

#endif
