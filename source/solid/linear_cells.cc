// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/linear_cells.h>

namespace Touchstone
{
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
        nodes.push_back(matrix.node(dofs[kernel.local_dof(a, 0)]));
      }
    if (!any)
      {
        rows.resize(n * n_waiting);
        nodes.resize(n * n_waiting);
        return;
      }
    kernel.reinit(cell);
    kernel.become(n_waiting, stiffness);
    if (++n_waiting == 8)
      finish(matrix);
  }



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
