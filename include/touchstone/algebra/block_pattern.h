// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_block_pattern_h
#define touchstone_algebra_block_pattern_h

#include <touchstone/base/types.h>

#include <deal.II/base/partitioner.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Which nodes are coupled in the rows of this rank: where the blocks of a matrix
   * over nodes are.
   *
   * Nodes go by local indices, those of this rank first.
   */
  struct BlockPattern
  {
    /** @brief Of the dofs, three a node. */
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
    /** @brief Blocks whose transposes are blocks as well are stored once. */
    bool symmetric = false;
    /** @brief Row pointers. From start[node] to upper_end[node] are the blocks above the diagonal
     * that stand for their transposes in the rows of other nodes too; up to start[node + 1]
     * follow the diagonal block, and blocks of columns that other ranks own. Without symmetry
     * the first part is empty. */
    std::vector<std::size_t> start{0}, upper_end;
    /** @brief Their columns, in ascending order in each of both parts. */
    std::vector<unsigned int> column;

    unsigned int
    n_nodes() const
    {
      return upper_end.size();
    }

    /** @brief With those of other ranks. */
    unsigned int
    n_local_nodes() const
    {
      return (partitioner->locally_owned_size() + partitioner->n_ghost_indices()) / dim;
    }

    /** @brief Append the row of the next node: the @p columns for which it has() blocks,
     * in ascending order. */
    void
    add_row(const std::vector<unsigned int> &columns)
    {
      const unsigned int node  = upper_end.size();
      const auto         twice = [&](const unsigned int other) {
        return symmetric && other > node && other < n_owned();
      };
      std::copy_if(columns.begin(), columns.end(), std::back_inserter(column), twice);
      upper_end.push_back(column.size());
      std::remove_copy_if(columns.begin(), columns.end(), std::back_inserter(column), twice);
      start.push_back(column.size());
    }

    /** @brief Whether a row has a block for itself, or that of another one stands for it. */
    bool
    has(const unsigned int node, const unsigned int other) const
    {
      return !symmetric || other >= node;
    }

    /** @brief The number of a block that the row has(). */
    std::size_t
    block(const unsigned int node, const unsigned int other) const
    {
      const bool twice = symmetric && other > node && other < n_owned();
      const auto begin = column.begin() + (twice ? start[node] : upper_end[node]),
                 end   = column.begin() + (twice ? upper_end[node] : start[node + 1]);
      return std::lower_bound(begin, end, other) - column.begin();
    }

    /** @brief That on the diagonal. */
    std::size_t
    diagonal(const unsigned int node) const
    {
      // The first of its part: what precedes it is stored elsewhere.
      return symmetric ? upper_end[node] : block(node, node);
    }

    /** @brief The blocks below the diagonal: those of other rows of which they are the
     * transposes. */
    struct TransposedBlocks
    {
      /** @brief Row pointers. */
      std::vector<std::size_t> start;
      /** @brief The nodes in whose rows they are, in ascending order. */
      std::vector<unsigned int> nodes;
    };

    /** @brief Made anew unless somebody still has them: they take a tenth of the memory of a
     * matrix in single precision, and are needed where whole rows are read. */
    std::shared_ptr<const TransposedBlocks>
    transposed_blocks() const;

  private:
    mutable std::weak_ptr<const TransposedBlocks> known_transposed;

    unsigned int
    n_owned() const
    {
      return partitioner->locally_owned_size() / dim;
    }
  };
} // namespace Touchstone

#endif
