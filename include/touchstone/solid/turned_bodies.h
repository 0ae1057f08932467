// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_turned_bodies_h
#define touchstone_solid_turned_bodies_h

#include <touchstone/solid/solid.h>

#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief What there is to tell of turned_bodies(). */
  struct TurnedBodies
  {
    std::vector<std::string> warnings;
    /** Why the result cannot be right; empty if no body has turned so far. */
    std::string failure;
  };

  /**
   * @brief Bodies at small strain that have turned so far that their strains are wrong
   * (doc/theory.md 2.1), each with the error and the remedy, in words.
   *
   * A turn by theta has the linear strain cos(theta) - 1 across its axis. It is told of where that
   * is more than 1e-3 for the mean turn of the body, and is a failure from 0.1 on (26 degrees).
   *
   * @param u Displacement with ghosts. Collective.
   */
  TurnedBodies
  turned_bodies(const Solid &solid, const Vector &u);
} // namespace Touchstone

#endif
