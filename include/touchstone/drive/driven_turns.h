// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_driven_turns_h
#define touchstone_drive_driven_turns_h

#include <touchstone/base/types.h>

#include <deal.II/base/tensor.h>

#include <functional>
#include <vector>

namespace Touchstone
{
  class Contact;

  /** @brief Rotation vectors of all bodies from one time to another, degrees: turns_of_supports().
   */
  using TurnsOfBodies = std::function<std::vector<dealii::Tensor<1, dim>>(double, double)>;

  /**
   * @brief The end of a step in which formulas turn no obstacle and no body too far: @p to, or the
   * first of its halves, quarters and so on that are short enough.
   *
   * A step knows where an obstacle is at its ends alone, to whole turns: what sticks to it or is
   * tied to it would follow the smaller rotation, and slip, a difference of positions, has the
   * direction of the chord and not of the tangent, so that a rotation by θ reduces the moment of
   * friction by the factor cos(θ/2) (doc/theory.md 6.2). 15 degrees are allowed with friction,
   * which is 0.9 %, and else 45; any for what touches nothing as the step begins, and
   * where a formula jumps. Collective. @param from Time of the committed state, which the contact
   * is in.
   */
  double
  end_of_turn(const Contact &contact, const TurnsOfBodies &turns_of_bodies, double from, double to);
} // namespace Touchstone

#endif
