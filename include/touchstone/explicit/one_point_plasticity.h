// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_one_point_plasticity_h
#define touchstone_explicit_one_point_plasticity_h

#include <touchstone/explicit/lanes.h>

namespace Touchstone
{
  /** @brief Constants of von Mises plasticity with linear isotropic hardening, force per area. */
  struct VonMisesConstants
  {
    double mu, kappa, yield_stress, hardening;
  };

  /**
   * @brief A cycle of the law "finite-strain von Mises" without kinematic hardening for eight cells
   * at once: the formulas of that law in the present configuration, with series for logarithm and
   * exponential that are exact to round-off for the elastic strains of metals (doc/explicit.md,
   * section 5).
   * @param gradient Gradients of the displacement, [3i+j].
   * @param state    History variables of the law, which go on.
   * @param stress   First Piola-Kirchhoff stress, [3i+j].
   * @param beyond   Not zero for cells that the series are not made for: state and stress of
   * these must come from the law itself.
   */
  void
  von_mises_cycle(const VonMisesConstants &constants,
                  const double (*gradient)[n_lanes],
                  double (*state)[n_lanes],
                  double (*stress)[n_lanes],
                  double *beyond);
} // namespace Touchstone

#endif
