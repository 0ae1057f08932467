// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_face_area_h
#define touchstone_contact_geometry_face_area_h

#include <touchstone/contact/geometry/trace_basis.h>

#include <array>

namespace Touchstone
{
  /** @brief The area of a facet in its present position. */
  double
  face_area(const Face &face);

  /** @brief The integral of the outward unit normal over a facet in its present position, area. */
  dealii::Tensor<1, dim>
  area_vector(const Face &face);

  /** @brief The integrals A_i of the shape functions of a face over its facet, area.
   * @param basis     Of a face with hanging nodes, or null.
   * @param reference In the reference state, not in the present position. */
  std::array<double, Face::max_nodes>
  whole_areas(const Face &face, const TraceBasis *basis, bool reference);

  /** @brief The derivatives of whole_areas() in the present position: [m][e][k] is that of the
   * integral of shape function k with respect to component e of the position of node m, length. */
  std::array<std::array<std::array<double, Face::max_nodes>, dim>, Face::max_nodes>
  whole_area_derivatives(const Face &face, const TraceBasis *basis);
} // namespace Touchstone

#endif
