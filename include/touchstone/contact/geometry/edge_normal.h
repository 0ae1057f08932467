// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_edge_normal_h
#define touchstone_contact_geometry_edge_normal_h

#include <touchstone/contact/geometry/face_derivative.h>

namespace Touchstone
{
  /**
   * @brief Unit normal of a master surface at one point, as a node meets it.
   *
   * That of FaceGeometry, and continuous with `Master normal = face` and on exact surfaces, too
   * (doc/theory.md 4, "Normals"): beside the edge between two faces it turns to the interpolation
   * of nodal normals, which both faces have on their common edge. In a valley between two faces a
   * node is balanced by a direction between their normals, on neither side of the edge by that of
   * the face.
   *
   * @param point geometry.evaluate(xi).
   */
  dealii::Tensor<1, dim>
  normal_over_edges(const FaceGeometry          &geometry,
                    const std::array<double, 2> &xi,
                    const FacePoint             &point);

  /** @brief The point at @p xi with this normal and all derivatives. */
  FaceDerivative
  differentiate_over_edges(const FaceGeometry &geometry, const std::array<double, 2> &xi);
} // namespace Touchstone

#endif
