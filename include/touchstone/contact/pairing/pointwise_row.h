// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_pointwise_row_h
#define touchstone_contact_pairing_pointwise_row_h

#include <touchstone/contact/row.h>
#include <touchstone/contact/search/search.h>

#include <unordered_map>
#include <vector>

namespace Touchstone
{
  /** @brief Set stencil, normal, gap vector and gap of the row of a point at @p x to those of its
   * partner on the master surface (doc/theory.md 3, "Node to surface"); the stencil is empty
   * before. */
  void
  set_pointwise_row(const ContactPartner &partner, const dealii::Point<dim> &x, ContactRow &row);

  /** @brief Add the faces whose averaged normals the row with this partner depends on. */
  void
  add_faces(const ContactPartner &partner, std::vector<const Face *> &faces);

  /** @brief Set the derivative of the row of a point at @p x, whose node is ContactRow::slave.
   * @param of_normals Search::normal_derivatives() of the faces of add_faces(). */
  void
  differentiate_pointwise_row(
    const Search                                                          &search,
    const std::unordered_map<const Face *, std::vector<NormalDerivative>> &of_normals,
    const ContactPartner                                                  &partner,
    const dealii::Point<dim>                                              &x,
    ContactRow                                                            &row);
} // namespace Touchstone

#endif
