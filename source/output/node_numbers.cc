// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/node_numbers.h>

#include <deal.II/fe/fe_tools.h>

namespace Touchstone
{
  NodeNumbers::NodeNumbers(const Solid &solid)
  {
    for (const unsigned int a :
         dealii::FETools::lexicographic_to_hierarchic_numbering<dim>(solid.fe.degree))
      first_dof.push_back(solid.fe.component_to_system_index(0, a));

    // Node k has the dofs 3k, 3k+1, 3k+2, which have one owner.
    const auto nodes_of = [&](const dealii::IndexSet &dofs) {
      dealii::IndexSet nodes(solid.dof_handler.n_dofs() / dim);
      for (auto range = dofs.begin_intervals(); range != dofs.end_intervals(); ++range)
        nodes.add_range(*range->begin() / dim, range->last() / dim + 1);
      nodes.compress();
      return nodes;
    };
    partitioner =
      std::make_shared<const dealii::Utilities::MPI::Partitioner>(nodes_of(solid.owned),
                                                                  nodes_of(solid.relevant),
                                                                  solid.communicator);
  }



  void
  NodeNumbers::of_cell(const Cell &cell, std::vector<unsigned int> &nodes) const
  {
    dofs.resize(cell->get_fe().n_dofs_per_cell());
    cell->get_dof_indices(dofs);
    nodes.resize(first_dof.size());
    for (unsigned int a = 0; a < nodes.size(); ++a)
      nodes[a] = partitioner->global_to_local(dofs[first_dof[a]] / dim);
  }
} // namespace Touchstone
