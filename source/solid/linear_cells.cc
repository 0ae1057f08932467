#include <touchstone/solid/linear_cells.h>

namespace Touchstone
{
  void
  LinearCells::add(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
                   RowWriter                                                    &writer)
  {
    const unsigned int n = kernel.nodes_per_cell();
    cell->get_dof_indices(dofs);
    bool any = false;
    for (unsigned int a = 0; a < n; ++a)
      {
        rows.push_back(writer.row(dofs[kernel.local_dof(a, 0)]));
        any = any || rows.back() >= 0;
        for (unsigned int d = 0; d < dim; ++d)
          columns.push_back(writer.column(dofs[kernel.local_dof(a, d)]));
      }
    if (!any)
      {
        rows.resize(n * n_waiting);
        columns.resize(dim * n * n_waiting);
        return;
      }
    kernel.reinit(cell);
    kernel.become(n_waiting, stiffness);
    if (++n_waiting == 8)
      finish(writer);
  }



  void
  LinearCells::finish(RowWriter &writer)
  {
    const unsigned int n = kernel.nodes_per_cell();
    if (n_waiting > 0)
      stiffness.compute();
    for (unsigned int k = 0; k < n_waiting; ++k)
      writer.add(n,
                 &rows[n * k],
                 &columns[dim * n * k],
                 [&](const unsigned int i, const unsigned int j) { return stiffness(i, j, k); });
    n_waiting = 0;
    rows.clear();
    columns.clear();
  }
} // namespace Touchstone
