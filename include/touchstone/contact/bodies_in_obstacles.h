// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_bodies_in_obstacles_h
#define touchstone_contact_bodies_in_obstacles_h

#include <touchstone/contact/contact.h>

#include <string>
#include <vector>

namespace Touchstone
{
  class ContactPair;

  /** @brief Where a body reaches into an obstacle with a face that no pair of both names. */
  struct BodyInObstacle
  {
    /** How deep, and the size of the cell there; length. Zero if nowhere. */
    double             depth = 0., size = 0.;
    dealii::Point<dim> x;

    /** @brief Pair, place and remedy in words. */
    std::string
    text(const ContactPair &pair) const;
  };

  /**
   * @brief The deepest point, of corners and centres of faces, of the slave body of a pair with an
   * obstacle that lies within this on a face that no pair of both names (doc/theory.md 4.1).
   *
   * Rows know nothing of such faces: a block of which only the upper side is named falls through
   * the ground. Points count from a quarter of the size of the cell on, unless they were half as
   * deep at the start. Without depth for pairs of two bodies. Collective.
   */
  BodyInObstacle
  body_in_obstacle(const Contact &contact, const ContactPair &pair);

  /** @brief The same of all pairs, in words. Collective. */
  std::vector<std::string>
  bodies_in_obstacles(const Contact &contact);
} // namespace Touchstone

#endif
