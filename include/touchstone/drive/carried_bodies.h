// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_carried_bodies_h
#define touchstone_drive_carried_bodies_h

#include <touchstone/contact/contact.h>

#include <vector>

namespace Touchstone
{
  /** @brief What the obstacle that a row faces does from the start of the step to time @p t, at the
   * contact point; length. */
  dealii::Tensor<1, dim>
  motion_of_obstacle(const Contact &contact, const ContactRow &row, double t);

  /**
   * @brief Let bodies without prescribed displacements move with what they touch, if a translation
   * does that: along the normals of rows that slide or have no friction, in all directions where
   * they stick or are tied (doc/theory.md 5, "First guess").
   *
   * Of bodies that hold each other nothing is known, and they stay. Collective.
   *
   * @param contact   At the start of the step.
   * @param supported By number of the body: 1 if any displacement of it is prescribed.
   * @param motions   Of the bodies until time @p t, length: those of such bodies are set.
   */
  void
  carry_bodies(const Contact                       &contact,
               const std::vector<int>              &supported,
               double                               t,
               std::vector<dealii::Tensor<1, dim>> &motions);
} // namespace Touchstone

#endif
