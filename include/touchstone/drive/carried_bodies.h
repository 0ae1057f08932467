// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_carried_bodies_h
#define touchstone_drive_carried_bodies_h

#include <touchstone/contact/contact.h>
#include <touchstone/solid/boundary_conditions.h>

#include <set>

namespace Touchstone
{
  /** @brief What carry_bodies() has to know of a step. */
  struct StepOfBodies
  {
    const BoundaryConditions &conditions;
    /** At the start of the step. */
    const Contact &contact;
    const Solid   &solid;
    /** Those that supports alone leave a motion. */
    const std::set<unsigned int> &unsupported;
    /** Displacement at the start of the step, owned dofs. */
    const Vector &committed_u;
    /** At its end. */
    double time;
  };

  /**
   * @brief Make a first guess of a step: move bodies that contact holds with what they touch, if a
   * translation does that (doc/theory.md 5, "First guess").
   *
   * It is the one that comes closest to the motions of obstacles and driven bodies along the
   * normals of rows that press and slide or have no friction, and in all directions where they
   * stick or are tied; and to what is prescribed of the body. Bodies stay that have another guess
   * already, that touch a body of which nothing is known, or that no translation brings to all of
   * this within a hundredth of a slave face. Collective.
   *
   * @param u Guess for the displacement at the end of the step, in which driven bodies are where
   *          their supports move them; owned dofs, length.
   * @return whether any was moved.
   */
  bool
  carry_bodies(const StepOfBodies &step, Vector &u);
} // namespace Touchstone

#endif
