// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_gauss_kernels_h
#define touchstone_explicit_gauss_kernels_h

#include <touchstone/base/types.h>
#include <touchstone/explicit/n_lanes.h>

namespace Touchstone
{
  /** @brief Eight hexahedra with 2x2x2 points each, of which everything is computed at once. */
  struct GaussBlock
  {
    static constexpr unsigned int n_cells = n_lanes, n_nodes = 8, n_points = 8;

    /** Local nodes of each cell. */
    unsigned int nodes[n_cells][n_nodes];
    /** Of each point the inverse of the Jacobian of the undeformed cell, [3d+j], and the volume
     * that it stands for. */
    double inverse[n_points][dim * dim][n_cells], weight[n_points][n_cells];
  };

  namespace GaussKernels
  {
    /** What a law is given and has answered at the points of eight cells. Tensors are [3i+j]. */
    struct Points
    {
      /** Gradients of the displacement, which with F-bar give the modified deformation. */
      double gradient[GaussBlock::n_points][dim * dim][GaussBlock::n_cells];
      /** First Piola-Kirchhoff stresses of that deformation. */
      double stress[GaussBlock::n_points][dim * dim][GaussBlock::n_cells];
      /** With F-bar (J_mean / J)^{1/3}, and the mean and the smallest determinant of each cell. */
      double alpha[GaussBlock::n_points][GaussBlock::n_cells];
      double mean[GaussBlock::n_cells], smallest[GaussBlock::n_cells];
    };

    /** @brief Set all but the stresses. @p field by local node, [3n+i]. */
    void
    deform(const GaussBlock &block, const double *field, bool f_bar, Points &points);

    /** @brief Forces on the nodes, [3a+i]. */
    void
    set_forces(const GaussBlock &block,
               const Points     &points,
               bool              f_bar,
               double (*force)[GaussBlock::n_cells]);
  } // namespace GaussKernels
} // namespace Touchstone

#endif
