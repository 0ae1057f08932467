// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_block_kernels_h
#define touchstone_explicit_block_kernels_h

#include <touchstone/explicit/one_point_block.h>
#include <touchstone/explicit/viscosity.h>

namespace Touchstone
{
  /** @brief What cells of all kinds need of their present shape, eight cells at once. Fields are
   * those of local nodes, [3n+i]; @p u may be null: small strain. */
  namespace BlockKernels
  {
    /** Derivatives of the volumes by the sums of positions of OnePointBlock, [3m+i]. */
    using Derivatives = double[dim * (OnePointBlock::n_sums - 1)][n_lanes];

    /** @brief Rates of the volumes, relative to them; 0 where a volume is not positive. */
    void
    set_volume_rates(const BlockNodes &nodes,
                     const double     *positions,
                     const double     *u,
                     const double     *v,
                     double           *rate,
                     Derivatives      &derivatives);

    /** @brief Forces of bulk viscosity on the nodes of the cells, [3a+i]: its pressure times the
     * derivatives of the volumes. @p periods see Viscosity. */
    void
    set_viscous_forces(const Viscosity   &viscosity,
                       const double      *periods,
                       const double      *rate,
                       const Derivatives &derivatives,
                       double (*force)[n_lanes]);

    /** @brief The volumes, and sum_a b_a b_a^T / m_a with their derivatives b_a by the positions of
     * the nodes: 11, 22, 33, 23, 13, 12. @param masses Of the nodes, [a]. */
    void
    set_mobilities(const BlockNodes &nodes,
                   const double     *positions,
                   const double     *u,
                   const double (*masses)[n_lanes],
                   double *volume,
                   double (*mobility)[n_lanes]);

    /** @brief int N_a dV of the undeformed cells, [a], exact up to round-off. */
    void
    set_nodal_volumes(const BlockNodes &nodes, const double *positions, double (*volumes)[n_lanes]);

    /** @brief The largest square of the rate of any edge of each cell, relative to the edge. */
    void
    set_edge_rates(const BlockNodes &nodes,
                   const double     *positions,
                   const double     *u,
                   const double     *v,
                   double           *square);
  } // namespace BlockKernels
} // namespace Touchstone

#endif
