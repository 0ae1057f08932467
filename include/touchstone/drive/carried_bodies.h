// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_carried_bodies_h
#define touchstone_drive_carried_bodies_h

#include <touchstone/drive/body_holds.h>

namespace Touchstone
{
  /**
   * @brief Make a first guess of a step: move bodies that contact holds with what they touch, by a
   * translation if one does that, and else by a rotation as well (doc/theory.md 5, "First guess").
   *
   * It is the one that comes closest to the motions of obstacles and driven bodies along the
   * normals of rows that press and slide or have no friction, and in all directions where they
   * stick or are tied; and to what is prescribed of the body. Bodies stay that have another guess
   * already, that touch a body of which nothing is known, or that no translation brings to all of
   * this within a hundredth of a slave face, and no rotation near it. Collective.
   *
   * @param u Guess for the displacement at the end of the step, in which driven bodies are where
   *          their supports move them; owned dofs, length.
   * @return whether any was moved.
   */
  bool
  carry_bodies(const StepOfBodies &step, Vector &u);
} // namespace Touchstone

#endif
