// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_driven_turns_h
#define touchstone_drive_driven_turns_h

#include <touchstone/base/non_convergence.h>

#include <string>

namespace Touchstone
{
  class Contact;

  /** @brief An obstacle is to turn too far in one step. */
  class TurnsTooFar : public WrongPlace
  {
    using WrongPlace::WrongPlace;
  };

  /** @brief Looks for obstacles that formulas turn too far from one time to another.
   *
   * A step knows where an obstacle is at its ends alone, to whole turns: what sticks to it or is
   * tied to it would take the shortest way, and slip, the difference of positions, has the
   * direction of the chord and not that of the circle, so that a turn by θ makes friction smaller
   * by 1 − cos(θ/2) (doc/theory.md 6.2). 15 degrees are allowed with friction, which is 0.9 %, and
   * else 45.
   * @return which, in words; empty if there is none. The same on all ranks. */
  std::string
  turns_too_far(const Contact &contact, double from, double to);
} // namespace Touchstone

#endif
