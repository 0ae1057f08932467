// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/linear_cells.h>

namespace Touchstone
{
  /** Add a cell to the batch. Stiffness matrices are computed for eight cells at once, so cells
   * are collected until a batch is full. Ghost cells without any row of this rank would
   * contribute nothing and are skipped; their entries in the list are removed again. */
  void
  LinearCells::add(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
                   Matrix                                                       &matrix)
  {
    const unsigned int n = kernel.nodes_per_cell();
    cell->get_dof_indices(dofs);
    bool any = false;
    for (unsigned int a = 0; a < n; ++a)
      {
        rows.push_back(matrix.row(dofs[kernel.local_dof(a, 0)]));
        any = any || rows.back() >= 0;
      }
    if (!any)
      {
        rows.resize(n * n_waiting);
        return;
      }
    // Only nodes of cells that have a row of this rank are known to the matrix.
    for (unsigned int a = 0; a < n; ++a)
      nodes.push_back(matrix.node(dofs[kernel.local_dof(a, 0)]));
    kernel.reinit(cell);
    kernel.become(n_waiting, stiffness);
    if (++n_waiting == 8)
      finish(matrix);
  }



  /** Compute the batch, full or not, and add its cells to the rows of this rank. Lanes beyond the
   * last cell hold a copy of the first cell, with finite numbers, and their result is ignored. */
  void
  LinearCells::finish(Matrix &matrix)
  {
    const unsigned int n = kernel.nodes_per_cell();
    if (n_waiting > 0)
      stiffness.compute();
    for (unsigned int k = 0; k < n_waiting; ++k)
      matrix.add(n, &rows[n * k], &nodes[n * k], [&](const unsigned int i, const unsigned int j) {
        return stiffness(i, j, k);
      });
    n_waiting = 0;
    rows.clear();
    nodes.clear();
  }
} // namespace Touchstone
