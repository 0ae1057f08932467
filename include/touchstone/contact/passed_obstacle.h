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
  class PassedObstacle : public NonConvergence
  {
    using NonConvergence::NonConvergence;
  };

  /** @brief Looks in a state of balance for points of slave surfaces that have gone through an
   * obstacle within the step: in front of it or on it at both ends, within it between them on the
   * straight way as the obstacle sees it, in by one side and out by another (doc/theory.md 4.1).
   * @param committed The displacement when the step began, owned dofs.
   * @return where, in words; empty if there is none. The same on all ranks. Collective. */
  std::string
  passed_obstacle(const Contact &contact, const Vector &committed);
} // namespace Touchstone

#endif
