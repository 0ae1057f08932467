// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_cell_loops_h
#define touchstone_solid_cell_loops_h

#include <touchstone/base/types.h>

#include <deal.II/base/tensor.h>

namespace Touchstone
{
  /**
   * @brief The loops over nodes and quadrature points in which CellKernel spends its time, for
   * hexahedra of 8 nodes and points and of 27, in versions for several processors.
   *
   * The innermost index is contiguous in all arrays: points in nodal_sums(), nodes in the others.
   */
  namespace CellLoops
  {
    /** @brief The sums of a vector field at all points, sums[4i+d][q] = sum_a x_ai t[a][d][q].
     * @param n     Nodes, and points, of the cell.
     * @param field Nodal values, node a component i at 3a+i.
     * @param table For d < 3 the derivatives of the shapes on the unit cell, for d = 3 the shapes,
     *              [a][d][q]. */
    void
    nodal_sums(unsigned int n, const double *field, const double *table, double *sums);

    /** @brief Gradients of the shapes on the reference cell at a point, [d][a], per length.
     * @param unit    The same on the unit cell.
     * @param inverse d xi / dX, per length. */
    void
    shape_gradients(unsigned int                  n,
                    const double                 *unit,
                    const dealii::Tensor<2, dim> &inverse,
                    double                       *gradients);

    /** @brief Add w A : (grad N_a, grad N_b) of a point to the blocks [a][i][k][b].
     * @param gradients Of the shapes, [d][a]. @param weight Of the point, w.
     * @param symmetric Only those for a <= b are needed; others may be left out or hold anything.
     */
    void
    add_tangent(unsigned int                  n,
                const double                 *gradients,
                double                        weight,
                const dealii::Tensor<4, dim> &A,
                bool                          symmetric,
                double                       *blocks);
  } // namespace CellLoops
} // namespace Touchstone

#endif
