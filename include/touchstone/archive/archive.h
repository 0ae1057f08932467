// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_archive_archive_h
#define touchstone_archive_archive_h

#include <touchstone/algebra/vector.h>
#include <touchstone/base/types.h>

#include <deal.II/base/utilities.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/grid/cell_id.h>

#include <functional>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

/**
 * @file
 * The state of a run in a form that any number of ranks can read back.
 *
 * Each rank writes a piece: named blocks of bytes as deal.II's Utilities::pack() makes
 * them, numbers in binary and without loss. The block "cells" lists the rank's active
 * cells by their CellId with the numbers of their nodes as the writer counts
 * them. All else refers to these numbers; who reads finds the same cells in a mesh of
 * its own and so knows which node is which, whatever the partition.
 */

namespace Touchstone
{
  /** @brief Pieces that this program has not written, or that are of another scene. */
  class ArchiveError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /** @brief Data of a node: values, nodes that it refers to, which may be of any rank, and keys
   * that mean the same in any partition. */
  struct NodeRecord
  {
    Index                      node = invalid_index;
    std::vector<double>        values;
    std::vector<Index>         nodes;
    std::vector<std::uint64_t> keys;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &node &values &nodes &keys;
    }
  };

  /** @brief Pairs of keys: a distributed set, of which each rank contributes a part. */
  using KeyPairs = std::vector<std::pair<std::uint64_t, std::uint64_t>>;

  /** @brief Gathers the state of this rank. Names are free, but each is given once. */
  class ArchiveWriter
  {
  public:
    /** @param dof_handler Of the mesh that the state lives on, with dim displacements per node. */
    explicit ArchiveWriter(const dealii::DoFHandler<dim> &dof_handler);

    /** @brief Anything that boost can serialise; of rank 0, the same for all. */
    template <class T>
    void
    put(const std::string &name, const T &value)
    {
      put_block(value_prefix + name, value);
    }

    /** @brief A field over the dofs, without ghosts. */
    void
    put_field(const std::string &name, const Vector &field);

    /** @brief Data of cells, any number of values for each.
     * @param values Called with the active cell index of each owned cell. */
    void
    put_cells(const std::string                                           &name,
              const std::function<std::vector<double>(unsigned int cell)> &values);

    /** @brief Records of nodes that this rank owns. */
    void
    put_nodes(const std::string &name, const std::vector<NodeRecord> &records);

    void
    put_keys(const std::string &name, const KeyPairs &keys);

    /** @brief All that has been put, as bytes. */
    std::vector<char>
    piece() const;

    /** @name What the names of blocks begin with */
    /** @{ */
    static constexpr const char *value_prefix = "value ", *field_prefix = "field ",
                                *cell_prefix = "cell data ", *node_prefix = "nodes ",
                                *key_prefix = "keys ";
    /** @} */

  private:
    const dealii::DoFHandler<dim>           &dof_handler;
    std::map<std::string, std::vector<char>> blocks;

    template <class T>
    void
    put_block(const std::string &name, const T &value)
    {
      std::vector<char> &block = blocks[name];
      AssertThrow(block.empty(), dealii::ExcMessage("The archive has a block " + name));
      dealii::Utilities::pack(value, block, /*allow_compression=*/false);
    }
  };

  /**
   * @brief Reads what writers have written, on any number of ranks.
   *
   * First get() and refined_cells(), to make the mesh; then connect(), and the rest.
   */
  class ArchiveReader
  {
  public:
    /** @param source The bytes of piece 0 to @p n_pieces - 1. */
    ArchiveReader(const std::function<std::vector<char>(unsigned int)> &source,
                  unsigned int                                          n_pieces);

    /** @brief A value; @throws ArchiveError if there is none. */
    template <class T>
    T
    get(const std::string &name) const
    {
      const std::vector<char> &bytes = block(piece(0), ArchiveWriter::value_prefix + name);
      return dealii::Utilities::unpack<T>(bytes, /*allow_compression=*/false);
    }

    /** @brief Whether a value was put. */
    bool
    has(const std::string &name) const
    {
      return piece(0).count(ArchiveWriter::value_prefix + name) > 0;
    }

    /** @brief Cells at or above @p level that have children: with these, a mesh whose
     * cells are of that level becomes that of the archive. */
    std::set<dealii::CellId::binary_type>
    refined_cells(unsigned int level) const;

    /** @brief Match nodes and cells of the pieces with those of the mesh of @p dof_handler, and
     * read this rank's share of all pieces. Collective. @throws ArchiveError, on all ranks, if the
     * mesh is another. */
    void
    connect(const dealii::DoFHandler<dim> &dof_handler);

    /** @brief Without ghosts. @throws ArchiveError if it is missing. */
    const Vector &
    field(const std::string &name) const;

    bool
    has_field(const std::string &name) const
    {
      return fields.count(name) > 0;
    }

    /** @brief Data of owned cells by active cell index; empty for other cells.
     * @throws ArchiveError if they are missing. */
    const std::vector<std::vector<double>> &
    cells(const std::string &name) const;

    /** @brief Records of the nodes that this rank owns, by node.
     * @throws ArchiveError if they are missing. */
    const std::map<Index, NodeRecord> &
    nodes(const std::string &name) const;

    /** @brief Of all ranks. */
    const KeyPairs &
    keys(const std::string &name) const;

  private:
    using Blocks = std::map<std::string, std::vector<char>>;

    const std::function<std::vector<char>(unsigned int)> source;
    const unsigned int                                   n_pieces;
    /** The piece that was read last. */
    mutable unsigned int present = dealii::numbers::invalid_unsigned_int;
    mutable Blocks       blocks;

    std::map<std::string, Vector>                           fields;
    std::map<std::string, std::vector<std::vector<double>>> cell_data;
    std::map<std::string, std::map<Index, NodeRecord>>      records;
    std::map<std::string, KeyPairs>                         key_pairs;

    const Blocks &
    piece(unsigned int number) const;
    static const std::vector<char> &
    block(const Blocks &piece, const std::string &name);
    /** What the present mesh makes of the numbers in the archive. */
    struct Matches
    {
      /** Present numbers of the nodes that this rank knows. */
      std::unordered_map<Index, Index> nodes;
      /** Present active indices of the cells of each piece that this rank owns, else invalid. */
      std::vector<std::vector<unsigned int>> cells;
    };
    /** @throws ArchiveError on all ranks, if the meshes differ. */
    Matches
    match_mesh(const dealii::DoFHandler<dim> &dof_handler);
    /** Take what piece @p i has of this rank's fields, cells and records. */
    void
    take_piece(unsigned int i, const Matches &matches, const dealii::DoFHandler<dim> &dof_handler);
    /** Give the nodes that records refer to their present numbers, some of which only
     * other ranks know. */
    void
    translate_references(const std::unordered_map<Index, Index> &present_nodes,
                         const dealii::DoFHandler<dim>          &dof_handler);
  };
} // namespace Touchstone

#endif
