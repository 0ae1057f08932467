// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_facing_part_h
#define touchstone_contact_pairing_facing_part_h

#include <touchstone/contact/geometry/face.h>

#include <array>

namespace Touchstone
{
  /** @brief Outward unit normal of the tangent plane at the centre of a face. */
  dealii::Tensor<1, dim>
  plane_normal(const Face &face);

  /** @brief Its derivatives with respect to the positions of the nodes, per length. */
  std::array<dealii::Tensor<2, dim>, Face::max_nodes>
  plane_normal_derivatives(const Face &face);

  /**
   * @brief The factor by which the area of a slave face counts where the master surface is inclined
   * to it: S(c; 0.3, 0.7), doc/theory.md 3.2.
   *
   * Points of both surfaces are paired along the normal of the slave face. Where the other surface
   * is steep, as towards the equator of a ball over a coarse plane, their distance and its normal
   * change within a face by more than a row can represent: averages with weights of both signs
   * are then no gap and no normal of any point, and the force of the row would not act against
   * its gap.
   */
  struct FacingPart
  {
    /** The part, and its derivative with respect to the cosine; no unit. */
    double value, by_cosine;

    /** @param cosine Of the angle between the slave face and the master surface. */
    explicit FacingPart(double cosine);
  };

  /** @brief Cosine of the angle between the plane of a slave face and a master surface with
   * averaged @p normal; found from the averaged normal alone where that is well below the angle
   * at which less than all of the area counts.
   * @param plane plane_normal() of the slave face. @param exact Or null: facets. */
  double
  facing_cosine(const dealii::Tensor<1, dim> &plane,
                const dealii::Tensor<1, dim> &normal,
                const Face                   &master,
                const AnalyticSurface        *exact,
                const std::array<double, 2>  &xi);
} // namespace Touchstone

#endif
