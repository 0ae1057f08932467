// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_one_point_kernels_h
#define touchstone_explicit_one_point_kernels_h

#include <touchstone/explicit/one_point_cells.h>

namespace Touchstone
{
  /** @brief Sign of hourglass mode @p m, xi eta, eta zeta, zeta xi, xi eta zeta, at node @p a. */
  constexpr int
  hourglass_sign(const unsigned int m, const unsigned int a)
  {
    const int x = a & 1 ? 1 : -1, y = a & 2 ? 1 : -1, z = a & 4 ? 1 : -1;
    return m == 0 ? x * y : m == 1 ? y * z : m == 2 ? z * x : x * y * z;
  }

  /** @brief What is computed of eight one-point cells at once. Tensors are [3i+j], fields those of
   * the nodes of the cells, [3a+i]. */
  namespace OnePointKernels
  {
    /** @brief The values of a field of local nodes, [3n+i], at the nodes of the cells. */
    void
    gather(const OnePointBlock &block,
           const double        *field,
           double (*values)[OnePointBlock::n_cells]);

    /** @brief Gradients of a field. */
    void
    set_gradients(const OnePointBlock &block,
                  const double (*field)[OnePointBlock::n_cells],
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
     * the hourglass modes of a field with these gradients. */
    void
    set_forces(const OnePointBlock &block,
               const double (*field)[OnePointBlock::n_cells],
               const double (*gradient)[OnePointBlock::n_cells],
               const double (*stress)[OnePointBlock::n_cells],
               Hourglass control,
               double (*force)[OnePointBlock::n_cells]);

    /** @brief Forces on the nodes, [3a+i], of bulk viscosity: its pressure times the derivative of
     * the volume, at this @p velocity. @p gradient of the displacement, null: small strain.
     * @p periods see Viscosity. */
    void
    set_viscous_forces(const OnePointBlock &block,
                       const double (*velocity)[OnePointBlock::n_cells],
                       const double (*gradient)[OnePointBlock::n_cells],
                       const Viscosity &viscosity,
                       const double    *periods,
                       double (*force)[OnePointBlock::n_cells]);

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
