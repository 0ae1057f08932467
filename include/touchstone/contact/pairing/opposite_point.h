// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_opposite_point_h
#define touchstone_contact_pairing_opposite_point_h

#include <touchstone/contact/geometry/face_derivative.h>
#include <touchstone/contact/geometry/overlap.h>

namespace Touchstone
{
  /**
   * @brief The point of a master face that faces a point of a slave face: on the line through the
   * slave point along the normal of the slave plane (doc/theory.md 3.3).
   *
   * Overlaps are computed on facets, and for these OverlapPoint has both points on such a line. The
   * exact surface over a facet is shifted along the surface as well, on both sides by different
   * lengths, so that on exact masters the point is sought on the surface itself. On facets and
   * smooth patches it is that of the facets.
   * @param x Point of the surface over the slave face.
   * @param plane plane_normal() of the slave face.
   * @param xi Coordinates of the point of the master's facet; set to those of the point.
   * @param point Set to position and tangents there.
   * @return false if the line does not meet the surface near the face, for which it must be too
   * inclined to count (FacingPart); then @p xi and @p point are undefined.
   */
  bool
  find_opposite_point(const FaceGeometry           &slave,
                      const dealii::Point<dim>     &x,
                      const FaceGeometry           &master,
                      const dealii::Tensor<1, dim> &plane,
                      std::array<double, 2>        &xi,
                      FacePoint                    &point);

  /** @brief find_opposite_point() with derivatives: sets @p point .master and .d_master.
   * @param on_slave The slave point, whose motion on its face is point.d_slave.
   * @tparam n Nodes of a face, 4 or 9. */
  template <unsigned int n>
  bool
  differentiate_opposite_point(const FaceGeometry        &slave,
                               const FacePosition        &on_slave,
                               const FaceDifferentiator  &master,
                               OverlapPointDerivative<n> &point);
} // namespace Touchstone

#endif
