// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_turned_bodies_h
#define touchstone_solid_turned_bodies_h

#include <touchstone/base/end_findings.h>
#include <touchstone/solid/solid.h>

namespace Touchstone
{
  /**
   * @brief Bodies at small strain that have turned so far that their strains are wrong
   * (doc/theory.md 2.1), each with the error and the remedy, in words.
   *
   * A turn by theta has the linear strain cos(theta) - 1 across its axis. It is told of where the
   * mean of that over the cells of a body is more than 1e-3: so bars that are bent are told of,
   * whose ends turn against each other. It is a failure where that of the mean turn of the body is
   * more than 0.1 (26 degrees).
   *
   * @param u Displacement with ghosts. Collective.
   */
  EndFindings
  turned_bodies(const Solid &solid, const Vector &u);
} // namespace Touchstone

#endif
