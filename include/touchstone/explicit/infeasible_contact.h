// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_infeasible_contact_h
#define touchstone_explicit_infeasible_contact_h

#include <touchstone/base/non_convergence.h>
#include <touchstone/contact/contact_parameters.h>

namespace Touchstone
{
  /** @brief No velocities obey both contact and what drives the bodies: supports press boundaries
   * into each other, or a body is squeezed from several sides. */
  class InfeasibleContact : public NonConvergence
  {
  public:
    explicit InfeasibleContact(const ContactPairParameters &pair);

    bool
    shorter_step_may_help() const override
    {
      return false;
    }
  };

  /** @brief Contact springs are too soft for what presses them: bodies pass through each other. */
  class SoftContact : public NonConvergence
  {
  public:
    SoftContact(const ContactPairParameters &pair, double time);

    bool
    shorter_step_may_help() const override
    {
      return false;
    }
  };
} // namespace Touchstone

#endif
