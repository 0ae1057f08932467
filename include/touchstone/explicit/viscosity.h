// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_viscosity_h
#define touchstone_explicit_viscosity_h

#include <touchstone/explicit/explicit_parameters.h>
#include <touchstone/solid/material_parameters.h>

#include <limits>

namespace Touchstone
{
  /**
   * @brief Bulk viscosity of a body: the pressure -viscosity r at the rate r of the volume.
   *
   * The period of a cell is 1/omega of its largest frequency. Instead of a length of the cell the
   * classical formulas have 2 kappa/(rho c omega): with it the linear part damps no mode of the
   * cell by more than 'Linear bulk viscosity' of the critical damping (doc/explicit.md, section 4).
   * Numbers are double, or vectors of them.
   */
  class Viscosity
  {
  public:
    /** @param cycle Length of the cycle; 0: whatever is stable. */
    Viscosity(const MaterialParameters &material,
              const ExplicitParameters &parameters,
              const double              cycle)
      : modulus(2. * material.bulk_modulus())
      , linear(parameters.linear_viscosity)
      , quadratic(parameters.quadratic_viscosity * parameters.quadratic_viscosity * modulus /
                  (material.bulk_modulus() + 4. / 3. * material.shear_modulus()))
      , inverse_cycle(cycle > 0. ? 1. / cycle : std::numeric_limits<double>::max())
      , cycle(cycle)
    {
    }

    /** @brief Part of the critical damping that is wanted at the rate @p rate of the volume. */
    template <typename Number>
    __attribute__((always_inline)) inline Number
    damping(const Number &rate, const Number &period) const
    {
      const Number compression = rate < 0. ? -rate : 0. * period;
      return linear + quadratic * period * compression;
    }

    /** @brief Force times time per area: what is wanted, but no more than is stable, as the cycle
     * was chosen before an impact came: h = 2/omega (sqrt(1 + xi^2) - xi), solved for xi. */
    template <typename Number>
    __attribute__((always_inline)) inline Number
    operator()(const Number &rate, const Number &period) const
    {
      const Number wanted = period * damping(rate, period),
                   most   = period * period * inverse_cycle - 0.25 * cycle,
                   bound  = most < 0. ? 0. * period : most;
      return modulus * (wanted < bound ? wanted : bound);
    }

  private:
    const double modulus, linear, quadratic, inverse_cycle, cycle;
  };
} // namespace Touchstone

#endif
