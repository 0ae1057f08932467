// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_node_map_h
#define touchstone_explicit_node_map_h

#include <touchstone/algebra/vector.h>
#include <touchstone/solid/solid.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief A vector at each node that a rank knows, by local node: owned nodes first, then
   * ghosts. */
  using NodeField = std::vector<dealii::Tensor<1, dim>>;

  /**
   * @brief The nodes and cells that a rank computes with in explicit dynamics, numbered locally, in
   * an order that does not depend on the partition.
   *
   * A rank computes all cells that have a node that it owns, ghost cells included, so that the sums
   * at owned nodes are complete without communication. Cells have keys made of their CellId, and
   * nodes the key of their first cell together with their place in it: sums that run in the order
   * of keys have the same bits on any number of ranks (doc/explicit.md, section 2). The mesh must
   * not change while this lives. Elements are of degree 1.
   */
  class NodeMap
  {
  public:
    /** @brief Number nodes and cells, and plan the messages. Collective.
     * @throws dealii::ExceptionBase if the keys of so many cells do not fit into 64 bits. */
    explicit NodeMap(const Solid &solid);
    ~NodeMap();
    NodeMap(const NodeMap &) = delete;
    NodeMap &
    operator=(const NodeMap &) = delete;

    static constexpr unsigned int nodes_per_cell = 8;

    /** @brief A cell that has an owned node, or is owned. */
    struct Cell
    {
      std::uint64_t key;
      /** Active cell index in the triangulation. */
      unsigned int index;
      unsigned int body : 31;
      /** Each cell is owned by one rank, which counts its energies. */
      unsigned int owned : 1;
    };
    /** @brief Local nodes in the order of FE_Q. */
    using CellNodes = std::array<unsigned int, nodes_per_cell>;

    unsigned int
    n_owned() const
    {
      return number_owned;
    }

    unsigned int
    n_local() const
    {
      return first_dofs.size();
    }

    /** @brief First dof of a local node; its components are this one and the next two. */
    Index
    dof(const unsigned int node) const
    {
      return first_dofs[node];
    }

    /** @brief The local node with this first dof; invalid_unsigned_int if it is not known here. */
    unsigned int
    local(Index first_dof) const;

    /** @brief A number that is the same on any number of ranks. Owned nodes ascend in it. */
    std::uint64_t
    key(const unsigned int node) const
    {
      return keys[node];
    }

    /** @brief Cells in the order of their keys. */
    const std::vector<Cell> &
    cells() const
    {
      return all_cells;
    }

    /** @brief Nodes of cell number @p c. Those of cells one after the other stand so in memory. */
    const CellNodes &
    nodes(const unsigned int c) const
    {
      return nodes_of_cells[c];
    }

    /** @brief Reference positions, length. */
    const NodeField &
    positions() const
    {
      return reference;
    }

    /** @brief Body of each local node. */
    unsigned int
    body(const unsigned int node) const
    {
      return bodies[node];
    }

    /** @brief Copy the values at owned nodes to the ranks that have them as ghosts. Collective
     * among neighbours. */
    void
    update_ghosts(NodeField &field) const;
    void
    update_ghosts(std::vector<double> &field) const;

    /** @brief Copy owned values to a vector without ghosts, and back. */
    void
    to_vector(const NodeField &field, Vector &vector) const;
    void
    from_vector(const Vector &vector, NodeField &field) const;

    MPI_Comm
    communicator() const
    {
      return comm;
    }

  private:
    const MPI_Comm comm;
    unsigned int   number_owned = 0;
    /** By local node. */
    std::vector<Index>         first_dofs;
    std::vector<std::uint64_t> keys;
    std::vector<unsigned int>  bodies;
    NodeField                  reference;
    /** First dofs, ascending, and their local nodes. */
    std::vector<std::pair<Index, unsigned int>> local_numbers;
    std::vector<Cell>                           all_cells;
    std::vector<CellNodes>                      nodes_of_cells;
    /** Ghosts of a rank stand next to each other: messages are received in place. */
    struct Neighbour
    {
      unsigned int rank;
      /** Owned nodes that this neighbour has as ghosts. */
      std::vector<unsigned int> sent;
      /** Its nodes that are ghosts here. */
      unsigned int first_ghost = 0, n_ghosts = 0;
    };
    std::vector<Neighbour>           neighbours;
    mutable std::vector<char>        buffer;
    mutable std::vector<MPI_Request> requests;

    /** Find the cells, with first dofs in place of nodes. */
    std::vector<std::array<Index, nodes_per_cell>>
    find_cells(const Solid &solid);
    void
    number_nodes(const Solid &solid, const std::vector<std::array<Index, nodes_per_cell>> &dofs);
    void
    plan_messages(const std::vector<unsigned int> &owners);
    void
    exchange(void *values, std::size_t size) const;
  };
} // namespace Touchstone

#endif
