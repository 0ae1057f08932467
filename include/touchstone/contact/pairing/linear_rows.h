// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_linear_rows_h
#define touchstone_contact_pairing_linear_rows_h

#include <touchstone/contact/pairing/pairing.h>

#include <vector>

namespace Touchstone
{
  /** @brief Reference positions of the nodes by dof, also of those that the stencils of @p rows
   * refer to; hanging nodes are where the nodes are that they follow, as displacements are. Length.
   * Collective. */
  Vector
  row_positions(const Solid &solid, const std::vector<ContactRow> &rows);

  /** @brief M X of a row in the reference state: the distance of its slave point from its place on
   * the facets of the master, times ContactRow::share; length.
   * @param positions See row_positions(). */
  dealii::Tensor<1, dim>
  row_offset(const ContactRow &row, const Vector &positions);

  /**
   * @brief Make the rows of a tied pair, in the reference state, exact for displacements that are
   * linear in space, a rotation of both bodies among them (doc/theory.md 4.6).
   *
   * The offset M X, which is not zero across a gap and between curved faces that do not match, is
   * carried by the displacement gradient in the master cell at the contact point: M u - (grad u)(M
   * X), with weights on the eight corners of the cell whose sum is zero. Rows whose offset is zero
   * up to round-off stay as they are. Collective.
   * @param input Of the pair, whose surfaces are in the reference state.
   */
  void
  make_linear(const PairingInput &input, std::vector<ContactRow> &rows);
} // namespace Touchstone

#endif
