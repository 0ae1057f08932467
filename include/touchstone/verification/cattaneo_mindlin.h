// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_verification_cattaneo_mindlin_h
#define touchstone_verification_cattaneo_mindlin_h

#include <touchstone/verification/reference_solution.h>

namespace Touchstone
{
  /**
   * @brief Line contact of two elastic cylinders of the same material that are
   * pressed together and then pushed sideways, at the forces that were computed.
   *
   * The axis of the cylinders is y, the normal force P acts along z and the
   * tangential force Q <= mu P along x, both per length. Normal and tangential
   * problem are independent, since the materials are equal:
   *   a^2 = 4 P R / (pi E*),   p(x) = p0 sqrt(1 - x^2/a^2),   p0 = 2 P / (pi a).
   * Under growing Q slip advances from the edges and leaves a strip |x| < c,
   *   c = a sqrt(1 - Q/(mu P)),
   *   q(x, c) = mu p0 (sqrt(1 - x^2/a^2) - c/a sqrt(1 - x^2/c^2)),
   * where a root is zero when it would be imaginary. When Q falls from its peak
   * Q*, slip in the other direction starts from the edges, for which friction
   * reaches from mu p to -mu p:
   *   c' = a sqrt(1 - (Q* - Q)/(2 mu P)),   q(x) = q(x, c*) - 2 q(x, c').
   *
   * Cattaneo (1938), Rend. Accad. Naz. Lincei 27; Mindlin (1949), J. Appl. Mech.
   * 16; Johnson, Contact Mechanics (1985), sections 4.2, 7.2 and 7.4.
   */
  class CattaneoMindlin : public ReferenceSolution
  {
  public:
    explicit CattaneoMindlin(const Scene &scene);
    CattaneoMindlin(ReferenceValues values, unsigned int pair);

    /** @brief Contact half-width a under the force @p normal per length, length. */
    double
    half_width(double normal) const;

    /** @brief Pressure in the middle, force per area. */
    double
    peak_pressure(double normal) const;

    /** @brief Half-width of the strip that does not slip at present, c or c';
     * NaN beyond full slip.
     * @param normal     P, force per length.
     * @param tangential Q now, force per length, not beyond @p peak.
     * @param peak       Q*, force per length, positive or negative. */
    double
    stick_half_width(double normal, double tangential, double peak) const;

    /** @brief Shear traction at @p x, force per area, positive along Q; the
     * arguments are those of stick_half_width(). */
    double
    shear_traction(double x, double normal, double tangential, double peak) const;

    ReferenceComparison
    compare(const ReferenceInput &input) const override;

  private:
    /** 1/R = 1/R1 + 1/R2. */
    double radius;
    /** E* = E / (2 (1 - nu^2)), force per area. */
    double effective_modulus;
    double friction;
    /** Extent of the model along y, length. */
    double depth;
    double centre;
    /** Forces on the model that the scene prescribes; NaN if it does not. */
    double       prescribed, prescribed_peak;
    unsigned int pair;

    /** Add the errors of the tractions as fields, where they are known. @param normal, tangential,
     * peak Forces per length. */
    void
    compare_fields(const ReferenceInput &input,
                   double                normal,
                   double                tangential,
                   double                peak,
                   ReferenceComparison  &result) const;
  };
} // namespace Touchstone

#endif
