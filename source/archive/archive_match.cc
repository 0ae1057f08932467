// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/archive/archive_blocks.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

// Which node and cell of an archive is which of the present mesh: cells of all pieces are found by
// their CellId, and thereby the nodes; then each rank takes what belongs to its own.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /**
     * Visit the blocks of one kind (prefix of ArchiveWriter) with their names: the reader need
     * not know which fields a run has written.
     */
    template <class Visitor>
    void
    for_each_block(const std::map<std::string, std::vector<char>> &blocks,
                   const std::string                              &prefix,
                   const Visitor                                  &visit)
    {
      for (const auto &[name, bytes] : blocks)
        if (name.compare(0, prefix.size(), prefix) == 0)
          visit(name.substr(prefix.size()), bytes);
    }
  } // namespace



  // Two passes over the pieces: the first finds cells and nodes, and compares the meshes before
  // anything is used; the second takes fields, data of cells and records.
  void
  ArchiveReader::connect(const DoFHandler<dim> &dof_handler)
  {
    const Matches matches = match_mesh(dof_handler);
    const auto    rank    = Utilities::MPI::this_mpi_process(dof_handler.get_communicator());
    for (unsigned int k = 0; k < n_pieces; ++k)
      take_piece((rank + k) % n_pieces, matches, dof_handler);
    // Entries were set by their owners only; compress() is collective nonetheless, and all ranks
    // have the same fields since each reads all pieces.
    for (auto &[name, field] : fields)
      field.compress(VectorOperation::insert);
    translate_references(matches.nodes, dof_handler);
    // Free the last piece: the data of this rank are taken out.
    present = numbers::invalid_unsigned_int;
    blocks.clear();
  }



  ArchiveReader::Matches
  ArchiveReader::match_mesh(const DoFHandler<dim> &dof_handler)
  {
    const unsigned int rank = Utilities::MPI::this_mpi_process(dof_handler.get_communicator());

    std::map<CellId::binary_type, typename DoFHandler<dim>::active_cell_iterator> cells;
    for (const auto &cell : dof_handler.active_cell_iterators())
      // Ghost cells, too: an owned node can lie in cells of which this rank owns none.
      if (!cell->is_artificial())
        cells.emplace(cell->id().template to_binary<dim>(), cell);

    // Each rank begins with its own piece: then they do not all read the same file.
    Matches result;
    result.cells.resize(n_pieces);
    std::size_t found_cells = 0, all_cells = 0;
    for (unsigned int k = 0; k < n_pieces; ++k)
      {
        const unsigned int i    = (rank + k) % n_pieces;
        const CellList     list = unpack<CellList>(block(piece(i), cells_block));
        all_cells += list.size();
        const std::size_t n = list.size() > 0 ? list.nodes.size() / list.size() : 0;
        result.cells[i].assign(list.size(), numbers::invalid_unsigned_int);
        for (std::size_t c = 0; c < list.size(); ++c)
          {
            const auto found = cells.find(list.id(c));
            if (found == cells.end())
              continue;
            const auto nodes = nodes_of_cell(dof_handler, found->second);
            // All nodes of known cells, not only owned ones: records on this rank may refer to
            // neighbours' nodes, and the owner of a node publishes its number below.
            for (unsigned int m = 0; m < std::min(n, nodes.size()); ++m)
              result.nodes[list.nodes[c * n + m]] = nodes[m];
            if (found->second->is_locally_owned() && n == nodes.size())
              {
                result.cells[i][c] = found->second->active_cell_index();
                ++found_cells;
              }
          }
      }
    const auto &mesh = dof_handler.get_triangulation();
    // Each cell of the archive must be owned by just one rank, and the mesh must have no others.
    // Decided by a sum, so that all ranks throw.
    if (Utilities::MPI::sum(found_cells, dof_handler.get_communicator()) != all_cells ||
        all_cells != mesh.n_global_active_cells())
      throw ArchiveError("it has another mesh, of " + std::to_string(all_cells) + " cells");
    return result;
  }



  void
  ArchiveReader::take_piece(const unsigned int     i,
                            const Matches         &matches,
                            const DoFHandler<dim> &dof_handler)
  {
    const Blocks &all = piece(i);
    // The present number of a node of the file, if this rank owns it: each value is taken by
    // its one owner.
    const auto own_place = [&](const Index node) {
      const auto found = matches.nodes.find(node);
      return found != matches.nodes.end() &&
                 dof_handler.locally_owned_dofs().is_element(dim * found->second)
               ? found->second
               : invalid_index;
    };
    for_each_block(all, ArchiveWriter::field_prefix, [&](const auto &name, const auto &bytes) {
      const FieldPart part  = unpack<FieldPart>(bytes);
      Vector         &field = fields[name];
      if (field.size() == 0)
        field.reinit(dof_handler.locally_owned_dofs(), dof_handler.get_communicator());
      for (std::size_t j = 0; j < part.values.size(); j += dim)
        if (const Index node = own_place((part.first + j) / dim); node != invalid_index)
          for (unsigned int d = 0; d < dim; ++d)
            field(dim * node + d) = part.values[j + d];
    });
    for_each_block(all, ArchiveWriter::cell_prefix, [&](const auto &name, const auto &bytes) {
      const auto values = unpack<std::vector<std::vector<double>>>(bytes);
      auto      &data   = cell_data[name];
      data.resize(dof_handler.get_triangulation().n_active_cells());
      for (std::size_t c = 0; c < values.size(); ++c)
        if (matches.cells[i][c] != numbers::invalid_unsigned_int)
          data[matches.cells[i][c]] = values[c];
    });
    for_each_block(all, ArchiveWriter::node_prefix, [&](const auto &name, const auto &bytes) {
      auto &mine = records[name];
      for (NodeRecord &record : unpack<std::vector<NodeRecord>>(bytes))
        if (const Index node = own_place(record.node); node != invalid_index)
          {
            record.node = node;
            mine.emplace(node, std::move(record));
          }
    });
    for_each_block(all, ArchiveWriter::key_prefix, [&](const auto &name, const auto &bytes) {
      const auto part = unpack<KeyPairs>(bytes);
      auto      &list = key_pairs[name];
      list.insert(list.end(), part.begin(), part.end());
    });
  }



  void
  ArchiveReader::translate_references(const std::unordered_map<Index, Index> &present_nodes,
                                      const DoFHandler<dim>                  &dof_handler)
  {
    // Records refer to nodes that may be far away, such as the master nodes of a contact row, so
    // no rank knows all of them. The translation of old number k is therefore held by rank k
    // modulo the number of ranks: owners publish theirs there, all others ask there. No rank
    // needs a table of all nodes.
    using Translations         = std::vector<std::pair<Index, Index>>;
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(dof_handler.get_communicator());
    std::map<unsigned int, Translations> published;
    for (const auto &[old, node] : present_nodes)
      if (dof_handler.locally_owned_dofs().is_element(dim * node))
        published[old % n_ranks].emplace_back(old, node);
    std::unordered_map<Index, Index> dictionary;
    for (const auto &[from, list] :
         Utilities::MPI::some_to_some(dof_handler.get_communicator(), published))
      dictionary.insert(list.begin(), list.end());

    // Each rank knows whom to ask, and answers come back in the same pattern; both exchanges are
    // sparse.
    std::map<unsigned int, std::vector<Index>> questions;
    for (const auto &[name, list] : records)
      for (const auto &[node, record] : list)
        for (const Index old : record.nodes)
          questions[old % n_ranks].push_back(old);
    std::map<unsigned int, Translations> answers;
    for (const auto &[from, list] :
         Utilities::MPI::some_to_some(dof_handler.get_communicator(), questions))
      for (const Index old : list)
        if (const auto found = dictionary.find(old); found != dictionary.end())
          answers[from].emplace_back(*found);
    std::unordered_map<Index, Index> translation;
    for (const auto &[from, list] :
         Utilities::MPI::some_to_some(dof_handler.get_communicator(), answers))
      translation.insert(list.begin(), list.end());

    for (auto &[name, list] : records)
      for (auto &[node, record] : list)
        for (Index &other : record.nodes)
          other = translation.at(other);
  }
} // namespace Touchstone
