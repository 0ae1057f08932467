// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_passed_obstacle_h
#define touchstone_contact_passed_obstacle_h

#include <touchstone/algebra/vector.h>
#include <touchstone/base/non_convergence.h>

#include <string>

namespace Touchstone
{
  class Contact;

  /** @brief A slave surface has passed through an obstacle within the step. */
  class PassedObstacle : public WrongPlace
  {
    using WrongPlace::WrongPlace;
  };

  /** @brief Looks in a state of balance for points of slave surfaces that have gone through an
   * obstacle within the step: on the straight way from where they were, past the obstacle as it
   * moves, they come in by one side of it and go out by another one (doc/theory.md 4.1).
   * @param committed The displacement when the step began, owned dofs.
   * @return where, in words; empty if there is none. The same on all ranks. Collective. */
  std::string
  passed_obstacle(const Contact &contact, const Vector &committed);
} // namespace Touchstone

#endif
