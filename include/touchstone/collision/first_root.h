// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_collision_first_root_h
#define touchstone_collision_first_root_h

#include <touchstone/collision/relative_motion.h>

namespace Touchstone
{
  /** @brief What is known of a motion from the roots of the volume between four points. */
  enum class Verdict
  {
    /** @brief There is certainly no crossing. */
    apart,
    /** @brief There certainly is one, and none before. */
    crossing,
    /** @brief Round-off decides: first_inclusion() must. */
    unsure
  };

  /**
   * @brief The first crossing of a motion by the roots of the volume of the four points, a cubic of
   * time: the fast way for all but degenerate motions (Provot 1997; roots by Yuksel 2022,
   * "High-performance polynomial root finding for graphics").
   *
   * Every value is compared with a bound of its round-off (Shewchuk 1997), and where that does not
   * decide the verdict is Verdict::unsure.
   *
   * @param motion Differences of the points.
   * @param crossing Is set for Verdict::crossing.
   */
  Verdict
  first_root(const RelativeMotion &motion, Crossing &crossing);
} // namespace Touchstone

#endif
