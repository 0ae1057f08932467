// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_verification_hill_tube_h
#define touchstone_verification_hill_tube_h

#include <touchstone/verification/reference_solution.h>

namespace Touchstone
{
  /**
   * @brief A thick tube of incompressible elastic, perfectly plastic material
   * under internal pressure, in plane strain with small strain, and what stays
   * in it after unloading.
   *
   * The tube reaches from radius a to b about the z axis; it yields by von
   * Mises, sigma_theta - sigma_r = 2k with k = yield stress/sqrt(3), up to the
   * radius c at which
   *   p/k = 1 - c^2/b^2 + 2 ln(c/a).
   * With sigma_z = (sigma_r + sigma_theta)/2 the stresses are
   *   sigma_r     = k (-1 + c^2/b^2 - 2 ln(c/r)),  sigma_theta = sigma_r + 2k,  r < c,
   *   sigma_r     = m (1/b^2 - 1/r^2),  sigma_theta = m (1/b^2 + 1/r^2),        r > c,
   * with m = k c^2. Below p = k (1 - a^2/b^2) nothing yields, and m = p a^2 b^2/(b^2 - a^2).
   * Volume is kept in both zones, so everywhere u_r = m/(2 G r). Unloading by
   * the pressure d is elastic as long as d <= 2k (1 - a^2/b^2), and takes away the
   * elastic stress of d. Hill (1950), The Mathematical Theory of Plasticity,
   * section V.2, for nu = 1/2.
   *
   * The load may come from a core, an elastic tube from a_i to a of any
   * Poisson's ratio in frictionless contact with the bore, under the pressure P
   * inside. Lame's displacement of its skin is that of the bore:
   *   u_r(a) = (1+nu)/E a/(a^2 - a_i^2) ((1-2nu) (P a_i^2 - p a^2) + a_i^2 (P - p)).
   */
  class HillTube : public ReferenceSolution
  {
  public:
    /** Stresses in cylindrical coordinates, force per area. */
    struct Stress
    {
      double radial, hoop, axial;
    };

    explicit HillTube(const Scene &scene);
    HillTube(ReferenceValues values, unsigned int pair);

    /** @brief Radius up to which the tube yields at a @p pressure in its bore;
     * the inner radius if nothing yields. */
    double
    plastic_radius(double pressure) const;

    /** @brief Pressure inside the core that presses the bore with @p pressure. */
    double
    core_pressure(double pressure) const;

    /** @brief Stress at radius @p r when the pressure has risen to @p peak and
     * fallen to @p pressure. */
    Stress
    stress(double r, double peak, double pressure) const;

    /** @brief The pressure in the bore at the peak, if it is known, else NaN. */
    double
    peak_pressure() const
    {
      return known_peak;
    }

    ReferenceComparison
    compare(const ReferenceInput &input) const override;

  private:
    double       inner, outer, shear_modulus, shear_yield;
    bool         has_core, unloaded;
    double       core_inner = 0., core_young = 0., core_nu = 0.;
    double       known_peak;
    unsigned int pair;

    /** m of the first loading. */
    double
    amplitude(double pressure) const;

    /** m of an elastic change of the pressure. */
    double
    elastic_amplitude(double pressure) const;
  };
} // namespace Touchstone

#endif
