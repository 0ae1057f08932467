// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_driven_bodies_h
#define touchstone_drive_driven_bodies_h

#include <touchstone/contact/contact.h>
#include <touchstone/solid/boundary_conditions.h>

namespace Touchstone
{
  /** @brief What a support misses at time @p t in the displacement @p u, owned dofs; length. */
  double
  missing_displacement(const BoundaryConditions::Prescribed &support, double t, const Vector &u);

  /**
   * @brief Make a first guess of a step: move those bodies that a translation brings to all of
   * their prescribed displacements at time @p t, and that nothing else holds.
   *
   * Contact is then looked for where these bodies will be and not where they come from: where they
   * slide to other nodes, the first iteration has the right active set. Stresses stay as they are.
   * A motion that closes gaps by more than the slave faces are wide is no guess for contact, and
   * not made. Collective.
   *
   * @param contact At the start of the step.
   * @param u       Displacement from which the bodies are moved, length; no ghosts.
   * @return whether any was moved.
   */
  bool
  move_driven_bodies(const BoundaryConditions &conditions,
                     const Contact            &contact,
                     const Solid              &solid,
                     double                    t,
                     Vector                   &u);
} // namespace Touchstone

#endif
