// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_points_in_faces_h
#define touchstone_contact_points_in_faces_h

#include <string>
#include <vector>

namespace Touchstone
{
  class Contact;

  /** @brief Let no material point have a row, or with plastic bodies only those that carried a
   * force when the last step ended: a step begins. Collective. */
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

  /** @brief Such points that carry a force. */
  struct PointsInContact
  {
    unsigned int n = 0;
    /** One for each pair that has some: its contact is narrower than the slave faces. */
    std::vector<std::string> warnings;
  };

  /** @brief Find them. Collective. */
  PointsInContact
  points_in_contact(const Contact &contact);
} // namespace Touchstone

#endif
