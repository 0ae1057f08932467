// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/node_positions.h>

#include <vector>

namespace Touchstone
{
  using namespace dealii;

  Vector
  node_positions(const Solid &solid)
  {
    Vector             result = solid.zero_vector();
    std::vector<Index> dofs(solid.fe.n_dofs_per_cell());
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell->get_dof_indices(dofs);
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (solid.owned.is_element(dofs[i]))
              result(dofs[i]) = solid.mapping.transform_unit_to_real_cell(
                cell, solid.fe.unit_support_point(i))[solid.fe.system_to_component_index(i).first];
        }
    result.compress(VectorOperation::insert);
    return result;
  }
} // namespace Touchstone
