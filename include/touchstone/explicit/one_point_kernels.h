// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_one_point_kernels_h
#define touchstone_explicit_one_point_kernels_h

#include <touchstone/explicit/one_point_block.h>
#include <touchstone/explicit/viscosity.h>

namespace Touchstone
{
  /** @brief What is computed of eight one-point cells at once. Tensors are [3i+j], sums of fields
   * with the signs of the modes of OnePointBlock [3m+i], values at the nodes of the cells [3a+i].
   */
  namespace OnePointKernels
  {
    /** @brief The sums of a field of local nodes, [3n+i], and its mean gradients. */
    void
    set_gradients(const BlockNodes    &nodes,
                  const OnePointBlock &block,
                  const double        *field,
                  double (*sums)[OnePointBlock::n_cells],
                  double (*gradient)[OnePointBlock::n_cells]);

    /** @brief How hourglass modes are controlled: by springs along the edges of the cell, which
     * turn with it or, at small strain, do not, or by dampers. */
    enum class Hourglass
    {
      convected,
      fixed,
      damped,
      none
    };

    /** @brief Forces on the nodes, [3a+i], of first Piola-Kirchhoff stresses, and of the control of
     * the hourglass modes of a field with these sums and gradients. */
    void
    set_forces(const OnePointBlock &block,
               const double (*sums)[OnePointBlock::n_cells],
               const double (*gradient)[OnePointBlock::n_cells],
               const double (*stress)[OnePointBlock::n_cells],
               Hourglass control,
               double (*force)[OnePointBlock::n_cells]);

    /** @brief Rates of the volumes, relative to them, and their derivatives by the displacement
     * gradients over the undeformed volumes: J F^{-T}. @param rates Gradients of the velocity.
     * @param gradient Of the displacement, null: small strain. */
    void
    set_volume_rates(const double (*rates)[OnePointBlock::n_cells],
                     const double (*gradient)[OnePointBlock::n_cells],
                     double *rate,
                     double (*derivatives)[OnePointBlock::n_cells]);

    /** @brief Stress of bulk viscosity at these rates: its pressure times the derivatives, which
     * become it. @p periods see Viscosity. */
    void
    set_viscous_stress(const Viscosity &viscosity,
                       const double    *periods,
                       const double    *rate,
                       double (*derivatives)[OnePointBlock::n_cells]);

    /** @brief Stress of Hooke's law by the gradients of the displacement. */
    void
    linear_elastic(double lambda,
                   double mu,
                   const double (*gradient)[OnePointBlock::n_cells],
                   double (*stress)[OnePointBlock::n_cells]);

    /** @brief First Piola-Kirchhoff stress of neo_hookean.cc; @p J gets the determinants of F. */
    void
    neo_hookean(double kappa,
                double mu,
                const double (*gradient)[OnePointBlock::n_cells],
                double (*stress)[OnePointBlock::n_cells],
                double *J);
  } // namespace OnePointKernels
} // namespace Touchstone

#endif
