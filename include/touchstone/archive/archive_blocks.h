// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_archive_archive_blocks_h
#define touchstone_archive_archive_blocks_h

#include <touchstone/base/types.h>

#include <deal.II/base/utilities.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/grid/cell_id.h>

#include <algorithm>
#include <boost/serialization/vector.hpp>
#include <tuple>
#include <vector>

// The blocks of an archive, as its writer and its reader know them.
namespace Touchstone
{
  /** Name of the block of the CellList. */
  constexpr const char *cells_block = "cells";

  // deal.II's pack() compresses by default; it is switched off here and where blocks are packed.
  template <class T>
  T
  unpack(const std::vector<char> &bytes)
  {
    return dealii::Utilities::unpack<T>(bytes, /*allow_compression=*/false);
  }

  /**
   * The active cells of a rank: their ids, and the numbers of their nodes. All are in two flat
   * lists, since boost would serialise one object per cell with an overhead each.
   */
  struct CellList
  {
    static constexpr std::size_t id_size = std::tuple_size<dealii::CellId::binary_type>::value;

    std::vector<unsigned int> ids;
    std::vector<Index>        nodes;

    std::size_t
    size() const
    {
      return ids.size() / id_size;
    }

    dealii::CellId::binary_type
    id(const std::size_t cell) const
    {
      dealii::CellId::binary_type result;
      std::copy_n(ids.begin() + cell * id_size, id_size, result.begin());
      return result;
    }

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &ids &nodes;
    }
  };

  /**
   * A part of a field: the values of the consecutive dofs that one rank owns, from @p first on.
   */
  struct FieldPart
  {
    Index               first = 0;
    std::vector<double> values;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &first &values;
    }
  };

  /**
   * Numbers of the nodes of a cell, in the order of the element. That order is the same in
   * every mesh, so nodes of equal position in the list of one cell are the same node. The dofs
   * of a node are consecutive, so the first component tells its number.
   */
  template <class Cell>
  std::vector<Index>
  nodes_of_cell(const dealii::DoFHandler<dim> &dof_handler, const Cell &cell)
  {
    std::vector<Index> dofs(dof_handler.get_fe().n_dofs_per_cell()), nodes;
    cell->get_dof_indices(dofs);
    for (unsigned int i = 0; i < dofs.size(); ++i)
      if (dof_handler.get_fe().system_to_component_index(i).first == 0)
        nodes.push_back(dofs[i] / dim);
    return nodes;
  }
} // namespace Touchstone

#endif
