// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_multigrid_prolongation_h
#define touchstone_algebra_multigrid_prolongation_h

#include <touchstone/algebra/block_matrix.h>
#include <touchstone/algebra/multigrid/padded_rows.h>
#include <touchstone/algebra/transformation.h>

#include <Epetra_MultiVector.h>
#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Transfer between two levels of multigrid by smoothed aggregation: prolongates
   * corrections to the finer level and restricts residuals to the coarser one.
   *
   * Three dofs make a node, on all levels. An aggregate() of the finer level has six
   * on the coarser one, its rigid motions: a pair of nodes there, which stay together. They
   * are smoothed by one step of Jacobi's method. If the coarser level is small, fewer ranks have it
   * than the finer one. Entries are kept in single precision, those
   * of galerkin() are exact for them. The product A P is never stored: for linear cells it
   * is three times as large as A.
   *
   * Vanek, Mandel and Brezina (1996), Computing 56.
   */
  class Prolongation
  {
  public:
    using VectorType = BlockMatrix<float>::VectorType;

    /** @brief Makes rigid motions over a level where they are needed, for they take the memory of
     * six vectors. */
    using NearKernel = std::function<std::shared_ptr<const Epetra_MultiVector>()>;

    /** @brief Rigid motions of an aggregate. */
    static constexpr unsigned int n_modes = 6;

    /** @brief Nodes that an aggregate is on the coarser level. */
    static constexpr unsigned int n_nodes_of_aggregate = n_modes / dim;

    /** @brief Block of the rows of an aggregate over the dofs of another, by rows; and while it
     * is summed up, which is faster with rows of eight. */
    using AggregateBlock = std::array<double, n_modes * n_modes>;
    using PaddedBlock    = PaddedRows<n_modes>;

    /** @brief A row of P^T A P: blocks over aggregates, which are named by local or by global
     * indices. */
    template <typename Block>
    class RowOfAggregates
    {
    public:
      Block &
      at(const int aggregate)
      {
        const auto found =
          std::lower_bound(positions.begin(), positions.end(), std::make_pair(aggregate, 0U));
        if (found != positions.end() && found->first == aggregate)
          return blocks[found->second];
        positions.emplace(found, aggregate, blocks.size());
        // Twice the memory whenever a row grows would be the most of a set-up.
        if (blocks.size() == blocks.capacity())
          blocks.reserve(blocks.size() + blocks.size() / 4 + 4);
        blocks.push_back({});
        return blocks.back();
      }

      /** @brief Aggregates in ascending order, with the number of their block. */
      std::vector<std::pair<int, unsigned int>> positions;
      std::vector<Block>                        blocks;
    };
    using AggregateRow = RowOfAggregates<AggregateBlock>;

    /**
     * @param matrix      Symmetric pattern.
     * @param near_kernel Rigid motions, zero at constrained dofs; at most n_modes.
     * @param body        Of this rank's nodes, or of its groups of nodes.
     * @param group       Nodes that follow each other and stay together: one on the finest
     *                    level, the nodes of an aggregate on the others.
     * @param largest     Largest eigenvalue of the matrix over its diagonal.
     */
    Prolongation(const BlockMatrix<float>        &matrix,
                 const NearKernel                &near_kernel,
                 const std::vector<unsigned int> &body,
                 unsigned int                     group,
                 double                           largest);

    /** @brief The matrix of the coarser level, P^T A P. @param matrix That of which the
     * constructor got the blocks, in double precision; forgets its rows one by one. @param
     * symmetric It is: of two blocks that are transposes of each other one is read, and of two
     * between aggregates of a rank one is computed. Collective. */
    std::unique_ptr<BlockRows>
    galerkin(BlockRows &matrix, bool symmetric) const;

    /** @brief Rigid motions over the coarser level. */
    const std::shared_ptr<const Epetra_MultiVector> &
    coarse_near_kernel() const
    {
      return coarse_kernel;
    }

    /** @brief Body of each aggregate that this rank has on the coarser level. */
    const std::vector<unsigned int> &
    coarse_body() const
    {
      return body_of_aggregate;
    }

    /** @brief Give @p vector the layout of the coarser level, with ghosts. */
    void
    initialize_coarse_vector(VectorType &vector) const
    {
      vector.reinit(coarse);
    }

    /** @brief fine += P coarse. Collective. */
    void
    prolongate_and_add(VectorType &fine, const VectorType &coarse) const;

    /** @brief coarse = P^T fine. Collective. */
    void
    restrict_to(VectorType &coarse, const VectorType &fine) const;

  private:
    static constexpr unsigned int block = dim * n_modes;

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> fine, coarse;
    /** P by rows of nodes of this rank: row pointers, aggregates by local index, and entries of
     * the blocks, row by row. */
    std::vector<std::size_t>  start;
    std::vector<unsigned int> column;
    /** Two more numbers than there are entries, like those of FarRow: rows of six are loaded as
     * registers of eight (PaddedRows). */
    std::vector<float> entries;

    std::shared_ptr<const Epetra_MultiVector> coarse_kernel;
    std::vector<unsigned int>                 body_of_aggregate;

    /** P_0 by nodes: the aggregate, or -1, and the block; two more numbers than there are entries,
     * as in `entries`. Aggregates are counted from the `first` one that was made on this rank,
     * until exchange() gives them the local numbers of the coarse level. */
    struct Tentative
    {
      Index              first = 0;
      std::vector<int>   aggregate;
      std::vector<float> blocks;
    };

    /** @brief P_0 of this rank's nodes and the near-kernel of the coarse level, from the @p nodes
     * of each aggregate. */
    Tentative
    restrict_to_aggregates(const Epetra_MultiVector                     &near_kernel,
                           const std::vector<std::vector<unsigned int>> &nodes);

    /** @brief Hand the coarse level over to fewer ranks if it is small (on_fewer_ranks()).
     * Collective. */
    void
    move_to_fewer_ranks();

    /** @brief Append the ghosts to P_0; makes the layout of the coarse level. Collective. */
    void
    exchange(Tentative &tentative);

    /** @brief The entries of P. */
    void
    smooth(BlockMatrix<float>::Rows &rows,
           const std::vector<float> &diagonal,
           const Tentative          &tentative,
           double                    omega);

    /** The rows of nodes of other ranks that this one refers to, by node: aggregates by
     * their global indices, and blocks. */
    struct FarRow
    {
      std::vector<Index> aggregates;
      std::vector<float> entries;
    };
    std::vector<FarRow>
    far_rows() const;

    /** @brief This rank's part of P^T A P, rows by local indices of aggregates, columns by
     * @p indices; if it is @p symmetric, without the blocks below the diagonal of which row and
     * column are of this rank. */
    std::vector<AggregateRow>
    part_of_galerkin(BlockRows &matrix, bool symmetric, LocalIndices &indices) const;

    /** @brief Sum up the parts of all ranks: on return @p parts are the rows of this rank's
     * aggregates, by the global indices of aggregates. */
    void
    sum_up(std::vector<AggregateRow> &parts, bool symmetric, const std::vector<int> &global) const;
  };
} // namespace Touchstone

#endif
