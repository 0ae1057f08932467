// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pulling_obstacle_h
#define touchstone_contact_pulling_obstacle_h

#include <touchstone/base/non_convergence.h>

#include <string>

namespace Touchstone
{
  class Contact;

  /** @brief An obstacle pulls at a slave surface that it has passed within the step. */
  class PullingObstacle : public WrongPlace
  {
    using WrongPlace::WrongPlace;
  };

  /** @brief Looks in a state of balance for an obstacle that pulls at a slave surface: within one
   * step it has come so far in that its nearest surface is the one on the other side, out of which
   * rows push the slave surface (doc/theory.md 4.1).
   * @return where, in words; empty if there is none. The same on all ranks. Collective. */
  std::string
  pulling_obstacle(const Contact &contact);
} // namespace Touchstone

#endif
