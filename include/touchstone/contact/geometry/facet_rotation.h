// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_facet_rotation_h
#define touchstone_contact_geometry_facet_rotation_h

#include <touchstone/contact/geometry/face.h>

#include <array>

namespace Touchstone
{
  /** @brief A matrix per node of a face. */
  using NodeMatrices = std::array<dealii::Tensor<2, dim>, Face::max_nodes>;

  /**
   * @brief The rotation R of a facet since the reference state, with which what an exact surface
   * has over the facet, its arch P(X) - X, turns: equation (8) of doc/theory.md 4.
   *
   * It takes the frame (e_1, e_2, e_1 x e_2) of the reference state to that of the present one,
   * where e_1 and e_2 halve the angles between the tangents at the middle of the face, so that
   * neither of them is preferred. The identity where they are parallel.
   */
  dealii::Tensor<2, dim>
  facet_rotation(const Face &face);

  /** @brief Its derivative by the present positions of the nodes: a motion dx_m turns R by the
   * vector W_m dx_m, dR = (W_m dx_m) x R.
   * @return W_m, 1/length. */
  NodeMatrices
  facet_rotation_derivative(const Face &face);

  /** @brief Nodes of a face relative to where a rotation of the reference state takes them, x_m - R
   * X_m, length: on a surface that turns with the facet these are what a displacement is on
   * one that does not. */
  std::array<dealii::Tensor<1, dim>, Face::max_nodes>
  relative_displacement(const Face &face, const dealii::Tensor<2, dim> &rotation);
} // namespace Touchstone

#endif
