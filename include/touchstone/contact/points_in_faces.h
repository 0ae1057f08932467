// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_points_in_faces_h
#define touchstone_contact_points_in_faces_h

#include <string>
#include <vector>

namespace Touchstone
{
  class Contact;

  /** @brief Let no material point have a row: a step begins. */
  void
  withdraw_points(Contact &contact);

  /** @brief Give rows to material points inside slave faces that the other surface has entered
   * between nodes that touch nothing, in a state of balance (doc/theory.md 4.2).
   * @return whether the state is to be solved again with other points. Collective. */
  bool
  place_points(Contact &contact);

  /** @brief The pairs that have such points, in words; empty without any. */
  std::string
  pairs_with_points(const Contact &contact);

  /** @brief How many such points carry a force. Collective. */
  unsigned int
  n_points_in_contact(const Contact &contact);

  /** @brief A warning for each pair whose contact such points carry: it is narrower than the slave
   * faces. Collective. */
  std::vector<std::string>
  warnings_of_points(const Contact &contact);
} // namespace Touchstone

#endif
