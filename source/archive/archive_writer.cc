// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/archive/archive_blocks.h>

#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

// Writing the state of a run as pieces that do not depend on the partition; it needs no
// communication. Values go through unchanged, bit by bit, so that a resumed run can repeat the one
// that was interrupted.
namespace Touchstone
{
  using namespace dealii;

  // The list of cells comes first: all other blocks refer to the numbers of nodes and to the
  // order of cells in it.
  ArchiveWriter::ArchiveWriter(const DoFHandler<dim> &dof_handler)
    : dof_handler(dof_handler)
  {
    CellList list;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const auto id    = cell->id().template to_binary<dim>();
          const auto nodes = nodes_of_cell(dof_handler, cell);
          list.ids.insert(list.ids.end(), id.begin(), id.end());
          list.nodes.insert(list.nodes.end(), nodes.begin(), nodes.end());
        }
    put_block(cells_block, list);
  }



  // Only the first number and the values: owned dofs are contiguous.
  void
  ArchiveWriter::put_field(const std::string &name, const Vector &field)
  {
    FieldPart part;
    if (dof_handler.locally_owned_dofs().n_elements() > 0)
      part.first = dof_handler.locally_owned_dofs().nth_index_in_set(0);
    AssertThrow(dof_handler.locally_owned_dofs().is_contiguous(), ExcInternalError());
    part.values.assign(field.begin(),
                       field.begin() + dof_handler.locally_owned_dofs().n_elements());
    put_block(field_prefix + name, part);
  }



  // Values in the order of the list of cells; a cell may have any number of them, such as
  // internal variables of its quadrature points.
  void
  ArchiveWriter::put_cells(const std::string                                           &name,
                           const std::function<std::vector<double>(unsigned int cell)> &values)
  {
    std::vector<std::vector<double>> all;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        all.push_back(values(cell->active_cell_index()));
    put_block(cell_prefix + name, all);
  }



  void
  ArchiveWriter::put_nodes(const std::string &name, const std::vector<NodeRecord> &all)
  {
    put_block(node_prefix + name, all);
  }



  void
  ArchiveWriter::put_keys(const std::string &name, const KeyPairs &keys)
  {
    put_block(key_prefix + name, keys);
  }



  std::vector<char>
  ArchiveWriter::piece() const
  {
    return Utilities::pack(blocks, /*allow_compression=*/false);
  }
} // namespace Touchstone
