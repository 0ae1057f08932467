// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_verification_hertz_h
#define touchstone_verification_hertz_h

#include <touchstone/verification/reference_solution.h>

namespace Touchstone
{
  /**
   * @brief Hertz's contact of spheres, at the force that was computed.
   *
   * Bodies of finite size do not follow Hertz's law of force against approach,
   * but the pressure under a given force is local:
   *   a = (3 P R / (4 E*))^(1/3),   p0 = 3 P / (2 pi a^2),
   *   p(r) = p0 sqrt(1 - r^2/a^2).
   */
  class Hertz : public ReferenceSolution
  {
  public:
    explicit Hertz(const Scene &scene);
    Hertz(ReferenceValues values, unsigned int pair);

    /** @brief Contact radius under the force @p force of the whole model,
     * length. */
    double
    contact_radius(double force) const;

    /** @brief Pressure in the centre under the force @p force, force per area. */
    double
    peak_pressure(double force) const;

    ReferenceComparison
    compare(const ReferenceInput &input) const override;

  private:
    /** 1/R = 1/R1 + 1/R2. */
    double radius;
    /** 1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2, force per area. */
    double                 effective_modulus;
    dealii::Tensor<1, dim> centre;
    /** How many times the model makes the whole: 4 for a quarter. */
    double       symmetry_factor;
    unsigned int pair;

    /** @brief Distance from the axis of the contact, length. */
    double
    distance(const dealii::Point<dim> &x, unsigned int axis) const;
  };
} // namespace Touchstone

#endif
