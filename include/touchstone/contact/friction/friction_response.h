// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_friction_friction_response_h
#define touchstone_contact_friction_friction_response_h

#include <touchstone/contact/row_state.h>

namespace Touchstone
{
  /**
   * @brief The tangential force of an active row with friction under the normal force
   * @p lambda, doc/theory.md 6.1: sets the response in the friction of @p state, from the
   * formulation there, and returns the force.
   */
  dealii::Tensor<1, dim>
  friction_response(const ContactRow &row, double lambda, RowState &state);

  /** @brief A linear solve has been evaluated: decide how stiff the springs of the row are in the
   * next one, see SpringStiffness; comes before friction_response(). */
  void
  judge_springs(const ContactRow &row, RowState &state);

  /**
   * @brief Evaluate the contact force of an active row from its normal force, slip and
   * status: force and response of @p state. A row without friction gets
   * force = lambda n; one that is tied is left alone.
   */
  void
  evaluate_force(const ContactRow &row, RowState &state);

  /**
   * @brief Let the friction of a row stay what it is at the normal force @p lambda,
   * so that it changes with its slip only and the system stays symmetric: changes the
   * response, and not the force.
   *
   * Where @p lambda comes from decides whether the iteration converges: it should be
   * the force that balances the slave node, and not a stiff spring times what a
   * linearisation has left of the gap.
   */
  void
  lag_friction(const ContactRow &row, RowState &state, double lambda);

  /** @brief Take the regularised formulation. */
  void
  regularise_friction(const ContactRow &row, RowState &state);

  /** @brief Take the formulation of an enforcement that constrains what sticks by
   * conditions: exact, unless the input sets regularised stick or the node is shared, see
   * FrictionForce::shared. */
  void
  choose_friction(const ContactRow &row, RowState &state);

  /** @brief Augment the force of the springs along unconstrained tangents by the present slip
   * times their stiffness. */
  void
  augment_unconstrained(const ContactRow &row, RowState &state);

  /** @brief The force of stick after a linear solve, in which the conditions of the row have made
   * RowState::force: with what the springs along unconstrained tangents carry, it is the base of
   * the next trial force. @param normal Of the row in the linear system. */
  void
  set_stick(RowState &state, const dealii::Tensor<1, dim> &normal);

  /** @brief The slip of the present step without its elastic part, the change of
   * the springs that regularised friction stores its force in.
   * @param force The present tangential force. */
  dealii::Tensor<1, dim>
  irreversible_slip(const FrictionRow            &friction,
                    const FrictionForce          &f,
                    const dealii::Tensor<1, dim> &force);
} // namespace Touchstone

#endif
