// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_moved_side_h
#define touchstone_drive_moved_side_h

#include <touchstone/contact/results.h>

#include <optional>
#include <vector>

namespace Touchstone
{
  /** @brief The bodies on one side of a contact pair: all that contact joins with that side when
   * the pair is taken away. To move their supports is to move one side of the pair against the
   * other. */
  struct MovedSide
  {
    /** By number of the body. */
    std::vector<bool> bodies;
    /** Whether it is the side of the slave body. */
    bool of_slave;
  };

  /**
   * @brief The side of @p pair that moves as a whole with the supports of its bodies: that of the
   * slave, or if another obstacle touches this one, that of the master. Nothing if other pairs join
   * both sides, or if obstacles touch both.
   * @param touching Whether each pair has contact.
   */
  std::optional<MovedSide>
  moved_side(const std::vector<PairBoundaries> &pairs,
             const std::vector<bool>           &touching,
             unsigned int                       pair,
             unsigned int                       n_bodies);
} // namespace Touchstone

#endif
