// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_row_nodes_h
#define touchstone_explicit_row_nodes_h

#include <touchstone/base/types.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief What a row is about, by keys that do not depend on the partition: rows in ascending
   * order of it are in the same order on any number of ranks. */
  struct RowKey
  {
    /** The pair of a row of Contact and its slave node; of other rows a number above those of all
     * pairs, and what meets what. */
    std::uint64_t                pair = 0, slave = 0;
    std::array<std::uint64_t, 3> others{};

    bool
    operator<(const RowKey &other) const
    {
      return pair != other.pair     ? pair < other.pair
             : slave != other.slave ? slave < other.slave
                                    : others < other.others;
    }
  };

  /**
   * @brief The nodes that the contact rows of this rank refer to, wherever they live, and the
   * nodes of this rank that rows of any rank refer to; with the messages between both
   * (doc/explicit.md, section 9.4).
   *
   * A slot is one mention of a node by a row. Owners send values of nodes to the rows
   * (forward()), rows send a vector for each slot to the owners, which sum them in the order of
   * row keys (sum()): so sums have the same bits on any number of ranks. Between calls of
   * reinit() no memory is allocated, and only ranks that share a row exchange messages.
   */
  class RowNodes
  {
  public:
    explicit RowNodes(MPI_Comm communicator);

    /**
     * @brief Plan the messages. Collective.
     * @param owned Dofs of this rank.
     * @param slots First dof of the node, and key of the row, of each slot; the slots of a row
     *              follow one another.
     */
    void
    reinit(const dealii::IndexSet &owned, const std::vector<std::pair<Index, RowKey>> &slots);

    /** @brief Nodes of this rank: local numbers below this. */
    unsigned int
    n_owned() const
    {
      return first_ghost;
    }

    /** @brief All known nodes. */
    unsigned int
    n() const
    {
      return dofs.size();
    }

    /** @brief First dof of a node. */
    Index
    dof(const unsigned int node) const
    {
      return dofs[node];
    }

    /** @brief The node of a slot. */
    unsigned int
    node(const std::size_t slot) const
    {
      return nodes_of_slots[slot];
    }

    std::size_t
    n_slots() const
    {
      return nodes_of_slots.size();
    }

    /** @brief Copy values of owned nodes to the ranks whose rows refer to them.
     * @tparam T Trivially copyable. Collective among neighbours. */
    template <class T>
    void
    forward(std::vector<T> &values) const
    {
      exchange(reinterpret_cast<char *>(values.data()), sizeof(T));
    }

    /** @brief Sum the vectors of the slots at owned nodes, in the order of row keys.
     * @param at_slots By slot. @param sums By node; of owned ones. Collective among neighbours. */
    void
    sum(const std::vector<dealii::Tensor<1, dim>> &at_slots,
        std::vector<dealii::Tensor<1, dim>>       &sums) const;

    /** @brief The same for the nodes alone that rows of other ranks refer to; the caller has summed
     * the others. */
    void
    sum_shared(const std::vector<dealii::Tensor<1, dim>> &at_slots,
               std::vector<dealii::Tensor<1, dim>>       &sums) const;

    /** @brief The owned nodes that rows of other ranks refer to. */
    const std::vector<unsigned int> &
    shared_nodes() const
    {
      return shared;
    }

    /** @brief No other rank has rows or nodes in common with this one. */
    bool
    alone() const
    {
      return neighbours.empty();
    }

    MPI_Comm
    communicator() const
    {
      return comm;
    }

  private:
    const MPI_Comm            comm;
    unsigned int              first_ghost = 0;
    std::vector<Index>        dofs;
    std::vector<unsigned int> nodes_of_slots;

    /** Another rank. */
    struct Neighbour
    {
      unsigned int rank;
      /** Owned nodes that it needs, its nodes that are ghosts here, by local number: the former in
       * the order in which it asked for them. */
      std::vector<unsigned int> wanted;
      unsigned int              first_ghost = 0, n_ghosts = 0;
      /** Slots here whose nodes it owns, and the place of its own slots on nodes of this rank. */
      std::vector<std::size_t> sent_slots;
      std::size_t              first_received = 0, n_received = 0;
    };
    std::vector<Neighbour> neighbours;
    /** Slots of all ranks on each owned node, in the order of row keys: own slots, and from
     * n_slots() on received ones. */
    std::vector<std::size_t> begin, contributions;
    /** Owned nodes with received slots. */
    std::vector<unsigned int> shared;

    /** A slot on a node of the rank that is asked, and those that each rank asks for. */
    struct SlotRequest
    {
      Index  dof;
      RowKey key;
    };
    using Requests = std::map<unsigned int, std::vector<SlotRequest>>;

    mutable std::vector<char>                   buffer;
    mutable std::vector<dealii::Tensor<1, dim>> sent, received;
    mutable std::vector<MPI_Request>            requests;

    /** The number of the node of each owned dof, in the order of the dofs; invalid for those that
     * no row mentions. */
    std::vector<unsigned int> numbers_of_owned;

    /** The number of an owned node that a row mentions. */
    unsigned int
    number(const dealii::IndexSet &owned, const Index dof) const
    {
      return numbers_of_owned[owned.index_within_set(dof)];
    }
    /** The steps of reinit(); @p ghosts are the numbers of nodes of other ranks by dof. */
    void
    number_owned(const dealii::IndexSet                      &owned,
                 const std::vector<std::pair<Index, RowKey>> &slots,
                 const Requests                              &asked);
    void
    number_ghosts(Neighbour                                   &neighbour,
                  const std::vector<std::pair<Index, RowKey>> &slots,
                  std::map<Index, unsigned int>               &ghosts);
    void
    order_contributions(const dealii::IndexSet                      &owned,
                        const std::vector<std::pair<Index, RowKey>> &slots,
                        const Requests                              &asked);
    void
    exchange(char *values, std::size_t size) const;
    void
    exchange_slots(const std::vector<dealii::Tensor<1, dim>> &at_slots) const;
    dealii::Tensor<1, dim>
    sum_at(unsigned int node, const std::vector<dealii::Tensor<1, dim>> &at_slots) const;
  };
} // namespace Touchstone

#endif
