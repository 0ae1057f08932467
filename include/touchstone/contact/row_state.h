// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_row_state_h
#define touchstone_contact_row_state_h

#include <touchstone/base/on_demand.h>
#include <touchstone/contact/enforcement/spring_stiffness.h>
#include <touchstone/contact/friction/friction_force.h>
#include <touchstone/contact/row.h>

namespace Touchstone
{
  /** @brief The present contact status of a row. */
  enum class ContactStatus : int
  {
    /** No master face within reach, or beyond the edge of the master surface. */
    no_partner = -1,
    /** A master face is there, but the gap is open. */
    open = 0,
    /** In contact, free to slide. */
    slip = 1,
    /** In contact, constrained in the tangential directions. */
    stick = 2,
    /** All components constrained, compression and tension. */
    tied = 3
  };

  /** @brief Status and contact force of a row. Owned by the Enforcement: nobody else writes
   * them. */
  struct RowState
  {
    ContactStatus status = ContactStatus::no_partner;
    /** Contact force on the slave node, force: lambda_n n + t_T. */
    dealii::Tensor<1, dim> force;
    /** Normal contact force, >= 0 in compression. */
    double lambda = 0.;
    /** Gap admitted when convergence is judged: the penetration of a penalty, length. */
    double admissible_gap = 0.;
    /** Conditions of the row that were accepted and refused, a bit each: of tied rows bit d for
     * axis d, of others in the order in which they are recorded. Supports or other rows determine
     * the displacement that a refused one is about. */
    unsigned int accepted = 0, refused = 0;
    /** The condition along the normal was accepted. */
    bool normal_accepted = true;
    /** Part of a cyclic dependency between contact pairs: imposes no constraint. */
    bool redundant = false;
    /** Of conditions that were refused and can be met. Begins anew with each step. */
    SpringStiffness spring;
    /** Only of rows with friction; others do not ask for it, for it is most of a state. */
    OnDemand<FrictionForce> friction;

    bool
    active() const
    {
      return status >= ContactStatus::slip;
    }

    /** @brief All components of the relative displacement are constrained by conditions: tied,
     * or stick that is not enforced by springs. */
    bool
    fully_constrained() const
    {
      return status == ContactStatus::tied ||
             (status == ContactStatus::stick && friction->constrained);
    }

    /** @brief Active, but supports or other rows determine all of its relative displacement: the
     * row carries no force. */
    bool
    dropped() const
    {
      return accepted == 0 && refused > 0;
    }

    /** @brief Supports or other rows determine component @p d of the gap of this tied row. */
    bool
    refuses(const unsigned int d) const
    {
      return (refused >> d) % 2 == 1;
    }

    /** @brief No contact force of any kind. */
    void
    clear_force()
    {
      lambda = 0.;
      force  = dealii::Tensor<1, dim>();
      spring = SpringStiffness();
      if (friction.made())
        friction->clear();
    }

    /** @brief Record whether a condition was accepted, that along the normal first; returns that.
     * @param can_be_met Whether nodes of the row are free to meet it if not. */
    bool
    record(const Condition &condition, const bool was_accepted, const bool can_be_met = true)
    {
      unsigned int bit = (accepted | refused) + 1;
      if (bit == 1)
        normal_accepted = was_accepted;
      else if (!was_accepted && status == ContactStatus::stick && friction->constrained)
        (can_be_met ? friction->unconstrained : friction->held).push_back(condition.direction);
      if (status == ContactStatus::tied)
        for (unsigned int d = 0; d < dim; ++d)
          if (condition.direction[d] != 0.)
            bit = 1u << d;
      (was_accepted ? accepted : refused) |= bit;
      return was_accepted;
    }

    /** @brief The one list of what checkpoints hold. */
    template <class State, class Visitor>
    static void
    visit_state(State &state, Visitor &&visit)
    {
      visit(state.status);
      visit(state.accepted);
      visit(state.refused);
      visit(state.redundant);
      visit(state.normal_accepted);
      visit(state.admissible_gap);
      visit(state.force);
      visit(state.lambda);
      FrictionForce::visit_state(*state.friction, visit);
    }
  };
} // namespace Touchstone

#endif
