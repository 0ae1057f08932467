// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_overlap_sample_h
#define touchstone_contact_pairing_overlap_sample_h

#include <touchstone/contact/geometry/face_derivative.h>
#include <touchstone/contact/geometry/overlap.h>
#include <touchstone/contact/geometry/vector3.h>

#include <Sacado.hpp>

namespace Touchstone
{
  /** @brief A number with its derivatives with respect to the positions of the nodes of a slave
   * face and of a master face, numbered as in OverlapPointDerivative.
   * @tparam n Nodes of a face, 4 or 9. */
  template <unsigned int n>
  using PositionFad = Sacado::Fad::SFad<double, int(OverlapPointDerivative<n>::n_variables)>;

  /**
   * @brief What averaged rows integrate over the overlap of a slave and a master face, at one
   * quadrature point.
   *
   * Two points that face each other along the normal of the slave plane: x_s = sum_j N_j x_j on
   * the slave face and x_m on the master surface (doc/theory.md 3 and 4).
   * @tparam n Nodes of a face, 4 or 9.
   * @tparam Number double, or PositionFad<n> for the derivatives as well.
   */
  template <unsigned int n, typename Number>
  struct OverlapSample
  {
    /** Area of the slave face, as far as the inclination of the surfaces lets it count
     * (FacingPart); zero at corners of the overlap. */
    Number weight;
    /** By how much less than all it lets count, 1 - S of FacingPart; no unit. */
    Number inclined;
    /** Shape functions N_j of the slave face and N_m of the master face. */
    std::array<Number, n> slave_shape, master_shape;
    /** x_s - x_m, length, and the unit outward normal of the master surface at x_m. */
    Vector3<Number> gap, normal;
    /** u_s - u_m, length. */
    Vector3<Number> moved;
    /** Distance of x_s from the facet over the nodes of the slave face, length. */
    Number arch;
  };

  /** @brief The values at a point.
   * @param plane plane_normal() of the slave face.
   * @return false if the surfaces are so inclined to each other that the point does not count;
   * then @p sample is undefined. */
  template <unsigned int n>
  bool
  evaluate(const OverlapPoint           &point,
           const FaceGeometry           &slave,
           const FaceGeometry           &master,
           const dealii::Tensor<1, dim> &plane,
           OverlapSample<n, double>     &sample);

  /** @brief The values and their derivatives at a point, at fixed nodal normals.
   * @param on_slave, on_master The two points, differentiated.
   * @return As evaluate(). */
  template <unsigned int n>
  bool
  differentiate(const OverlapPointDerivative<n>  &point,
                const FaceGeometry               &slave,
                const FacePosition               &on_slave,
                const FaceGeometry               &master,
                const FaceDerivative             &on_master,
                OverlapSample<n, PositionFad<n>> &sample);
} // namespace Touchstone

#endif
