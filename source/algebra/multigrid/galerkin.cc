// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/multigrid/prolongation.h>
#include <touchstone/algebra/multigrid/row_of_blocks.h>
#include <touchstone/base/exchange.h>
#include <touchstone/base/vectorised.h>

#include <algorithm>
#include <array>
#include <map>

// The matrix of the next coarser level, P^T A P (doc/theory.md, section 8). Node by node: one
// block row of A P is formed and at once multiplied by the blocks of P^T of that node, so A P is
// never stored. Ranks add up the rows of all aggregates that their nodes contribute to, then send
// those of other ranks to the owners. Sums are in double precision, although P is in single
// precision, because rigid motions have almost no energy: their entries are small differences.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_modes = Prolongation::n_modes;

    /** A block of P, in the message to a rank whose rows of A refer to its node. */
    struct SentBlockOfP
    {
      Index                            node, aggregate; // global indices
      std::array<float, dim * n_modes> entries;
    };

    /** A block of P^T A P, in the message to the rank that owns its row. */
    struct SentCoarseBlock
    {
      Index                        row, column; // aggregates, global indices
      Prolongation::AggregateBlock entries;
    };

    /**
     * Where the blocks of a row of P begin and what their columns are, by local index of the
     * node; so own rows and those of other ranks, which are stored differently, are read alike.
     */
    struct RowOfP
    {
      const float        *entries;
      const unsigned int *columns;
      std::size_t         size;
    };

    using PaddedBlock = Prolongation::PaddedBlock;

    /** product += factor a p, of a block a of the matrix and the row p of P of its column. */
    TOUCHSTONE_VECTORISED void
    add_product(BlockRows::Block       a,
                const double           factor,
                const RowOfP          &p,
                RowOfBlocks<NodeRows> &product)
    {
      for (double &entry : a)
        entry *= factor;
      for (std::size_t b = 0; b < p.size; ++b)
        Touchstone::add_product(a,
                                p.entries + dim * n_modes * b,
                                product.at(static_cast<int>(p.columns[b])));
    }

    /** to += p^T ap, of a block of P and one of A P. */
    TOUCHSTONE_VECTORISED void
    add_transposed_product(const float *p, const NodeRows &ap, PaddedBlock &to)
    {
      const Vector8 ap0 = ap[0], ap1 = ap[1], ap2 = ap[2];
      for (unsigned int i = 0; i < n_modes; ++i)
        to[i] +=
          double(p[i]) * ap0 + double(p[n_modes + i]) * ap1 + double(p[2 * n_modes + i]) * ap2;
    }

    /** to += ap^T p, its transpose. */
    TOUCHSTONE_VECTORISED void
    add_transposed_product(const NodeRows &ap, const float *p, PaddedBlock &to)
    {
      using Floats     = Simd<float, 8>::type;
      const Vector8 p0 = TOUCHSTONE_CONVERT(*reinterpret_cast<const Floats *>(p), Vector8),
                    p1 =
                      TOUCHSTONE_CONVERT(*reinterpret_cast<const Floats *>(p + n_modes), Vector8),
                    p2 = TOUCHSTONE_CONVERT(*reinterpret_cast<const Floats *>(p + 2 * n_modes),
                                            Vector8);
      for (unsigned int i = 0; i < n_modes; ++i)
        to[i] += ap[0][i] * p0 + ap[1][i] * p1 + ap[2][i] * p2;
    }

    /** A row that is complete, without padding. */
    Prolongation::AggregateRow
    pack(Prolongation::RowOfAggregates<PaddedBlock> &&row)
    {
      Prolongation::AggregateRow result;
      result.positions = row.positions;
      result.blocks.resize(row.blocks.size());
      for (std::size_t k = 0; k < row.blocks.size(); ++k)
        for (unsigned int i = 0; i < n_modes; ++i)
          for (unsigned int m = 0; m < n_modes; ++m)
            result.blocks[k][n_modes * i + m] = row.blocks[k][i][m];
      row = {};
      return result;
    }

    /**
     * The rows of aggregates as those of nodes: the six dofs of an aggregate are two nodes of
     * three, so a 6 x 6 block is 2 x 2 blocks of 3 x 3 and coarse levels need no code of their
     * own. Of a symmetric matrix the blocks of earlier aggregates are missing.
     */
    class AggregateRows : public BlockRows
    {
    public:
      /** @param rows By global indices of aggregates.
       *  @param coarse Has the dofs of this rank. */
      // The layout of the coarse level with the columns of its rows as ghosts. They reach further
      // than those of P: two aggregates are coupled if any of their smoothed columns overlap.
      AggregateRows(std::vector<Prolongation::AggregateRow> &&rows,
                    const bool                                symmetric,
                    const Partitioner                        &coarse)
        : BlockRows(make_partitioner(rows, coarse))
        , rows(std::move(rows))
        , symmetric(symmetric)
      {
        const int first = static_cast<int>(partitioner->local_range().first / n_modes);
        for (unsigned int row = 0; row < this->rows.size(); ++row)
          {
            // A motion that the aggregate does not have (one node has no rotations, a straight
            // row of nodes none about itself) is a zero column of P and a zero row here: a one on
            // the diagonal keeps the matrix regular, and the motion stays zero.
            Prolongation::AggregateBlock &own = this->rows[row].at(first + static_cast<int>(row));
            for (unsigned int i = 0; i < n_modes; ++i)
              if (own[(n_modes + 1) * i] == 0.)
                own[(n_modes + 1) * i] = 1.;
            for (auto &[aggregate, position] : this->rows[row].positions)
              aggregate = static_cast<int>(
                partitioner->global_to_local(n_modes * static_cast<Index>(aggregate)) / n_modes);
          }
      }

      const RowOfBlocks<Block> &
      read(const unsigned int node) override
      {
        present.clear();
        const unsigned int                begin = dim * (node % n_parts);
        const Prolongation::AggregateRow &row   = rows[node / n_parts];
        for (const auto &[aggregate, position] : row.positions)
          for (unsigned int part = 0; part < n_parts; ++part)
            {
              Block &to = present.at(static_cast<int>(n_parts * aggregate + part));
              for (unsigned int r = 0; r < dim; ++r)
                for (unsigned int c = 0; c < dim; ++c)
                  to[dim * r + c] = row.blocks[position][n_modes * (begin + r) + dim * part + c];
            }
        return present;
      }

      void
      forget(const unsigned int node) override
      {
        if (node % n_parts == n_parts - 1)
          rows[node / n_parts] = {};
      }

      std::size_t
      n_blocks() const override
      {
        std::size_t n = 0;
        for (const auto &row : rows)
          n += (symmetric ? 2 : 1) * row.positions.size();
        return n_parts * n_parts * n;
      }

    private:
      static constexpr unsigned int           n_parts = Prolongation::n_nodes_of_aggregate;
      std::vector<Prolongation::AggregateRow> rows;
      const bool                              symmetric;

      static std::shared_ptr<const Partitioner>
      make_partitioner(const std::vector<Prolongation::AggregateRow> &rows,
                       const Partitioner                             &coarse)
      {
        std::vector<Index> far;
        for (const auto &row : rows)
          for (const auto &[aggregate, position] : row.positions)
            for (unsigned int m = 0; m < n_modes; ++m)
              if (const Index i = n_modes * static_cast<Index>(aggregate) + m;
                  !coarse.in_local_range(i))
                far.push_back(i);
        std::sort(far.begin(), far.end());
        IndexSet ghosts(coarse.size());
        ghosts.add_indices(far.begin(), std::unique(far.begin(), far.end()));
        return std::make_shared<Partitioner>(coarse.locally_owned_range(),
                                             ghosts,
                                             coarse.get_mpi_communicator());
      }
    };
  } // namespace



  // Rows of P of nodes on other ranks that rows of A refer to. The owner of a node knows from the
  // partitioner who has it as a ghost and sends without being asked; one message per pair of
  // ranks.
  std::vector<Prolongation::FarRow>
  Prolongation::far_rows() const
  {
    std::map<unsigned int, std::vector<SentBlockOfP>> messages;
    std::vector<unsigned int>                         wanted;
    for (const auto &[begin, end] : fine->import_indices())
      for (unsigned int i = begin; i < end; ++i)
        wanted.push_back(i);
    auto next = wanted.begin();
    for (const auto &[rank, n] : fine->import_targets())
      for (const auto end = next + n; next != end; ++next)
        if (*next % dim == 0)
          {
            const unsigned int node = *next / dim;
            for (std::size_t b = start[node]; b < start[node + 1]; ++b)
              {
                SentBlockOfP sent{fine->local_to_global(*next) / dim,
                                  coarse->local_to_global(n_modes * column[b]) / n_modes,
                                  {}};
                std::copy_n(entries.begin() + block * b, block, sent.entries.begin());
                messages[rank].push_back(sent);
              }
          }
    std::vector<FarRow> result(fine->n_ghost_indices() / dim);
    for (const auto &[rank, blocks] : exchange_records(messages, fine->get_mpi_communicator()))
      for (const SentBlockOfP &received : blocks)
        {
          const unsigned int local = fine->global_to_local(dim * received.node);
          FarRow            &row   = result[(local - fine->locally_owned_size()) / dim];
          row.aggregates.push_back(received.aggregate);
          row.entries.insert(row.entries.end(), received.entries.begin(), received.entries.end());
        }
    for (FarRow &row : result)
      row.entries.resize(row.entries.size() + 2); // read beyond the end
    return result;
  }



  // This rank's contribution: the nodes that it owns, all aggregates that these belong to.
  // Smoothing extends P by one layer, so aggregates of neighbouring ranks are among them.
  std::vector<Prolongation::AggregateRow>
  Prolongation::part_of_galerkin(BlockRows    &matrix,
                                 const bool    symmetric,
                                 LocalIndices &indices) const
  {
    const unsigned int                     n_mine  = coarse->locally_owned_size() / n_modes;
    const unsigned int                     n_nodes = start.size() - 1;
    const std::vector<FarRow>              far     = far_rows();
    std::vector<std::vector<unsigned int>> far_columns(far.size());
    for (unsigned int i = 0; i < far.size(); ++i)
      for (const Index aggregate : far[i].aggregates)
        far_columns[i].push_back(indices.local(aggregate));
    const auto row_of_p = [&](const unsigned int node) {
      if (node < n_nodes)
        return RowOfP{entries.data() + block * start[node],
                      column.data() + start[node],
                      start[node + 1] - start[node]};
      const auto &aggregates = far_columns[node - n_nodes];
      return RowOfP{far[node - n_nodes].entries.data(), aggregates.data(), aggregates.size()};
    };

    // Of a symmetric matrix the blocks between nodes of this rank are read once for two: with U,
    // what is above the diagonal and half of this, P^T (U + U^T) P is a sum and its transpose. The
    // rest, all of a matrix that is not symmetric, is summed up as it is.
    std::vector<RowOfAggregates<PaddedBlock>> sums(
      (coarse->locally_owned_size() + coarse->n_ghost_indices()) / n_modes);
    const auto stored = [&](const unsigned int row, const unsigned int aggregate) {
      return !symmetric || aggregate >= row || row >= n_mine;
    };
    // A row gets nothing after the last node of its aggregate, for what it gets as a transpose
    // comes from earlier nodes; without symmetry from that node itself.
    std::vector<unsigned int> last(sums.size(), 0);
    for (unsigned int node = 0; node < n_nodes; ++node)
      for (std::size_t b = start[node]; b < start[node + 1]; ++b)
        last[column[b]] = node;
    std::vector<AggregateRow> result(sums.size());
    RowOfBlocks<NodeRows>     of_half, of_rest;
    for (unsigned int node = 0; node < n_nodes; ++node)
      {
        of_half.clear();
        of_rest.clear();
        const auto &row = matrix.read(node);
        for (unsigned int k = 0; k < row.columns.size(); ++k)
          if (const auto other = static_cast<unsigned int>(row.columns[k]);
              !symmetric || other >= n_nodes)
            add_product(row.blocks[k], 1., row_of_p(other), of_rest);
          else if (other >= node)
            add_product(row.blocks[k], other == node ? 0.5 : 1., row_of_p(other), of_half);
        matrix.forget(node);
        for (std::size_t b = start[node]; b < start[node + 1]; ++b)
          {
            const float *const of_node = entries.data() + block * b;
            const int          own     = static_cast<int>(column[b]);
            for (unsigned int k = 0; k < of_half.columns.size(); ++k)
              {
                const int other = of_half.columns[k];
                if (stored(own, other))
                  add_transposed_product(of_node, of_half.blocks[k], sums[own].at(other));
                if (stored(other, own))
                  add_transposed_product(of_half.blocks[k], of_node, sums[other].at(own));
              }
            for (unsigned int k = 0; k < of_rest.columns.size(); ++k)
              if (stored(own, of_rest.columns[k]))
                add_transposed_product(of_node,
                                       of_rest.blocks[k],
                                       sums[own].at(of_rest.columns[k]));
          }
        for (std::size_t b = start[node]; b < start[node + 1]; ++b)
          if (last[column[b]] == node)
            result[column[b]] = pack(std::move(sums[column[b]]));
      }
    return result;
  }



  // Columns become global indices first, as local ones mean nothing to other ranks, and are
  // sorted again, for AggregateRow::at() searches by bisection.
  void
  Prolongation::sum_up(std::vector<AggregateRow> &parts,
                       const bool                 symmetric,
                       const std::vector<int>    &global) const
  {
    for (AggregateRow &part : parts)
      {
        for (auto &[aggregate, position] : part.positions)
          aggregate = global[aggregate];
        std::sort(part.positions.begin(), part.positions.end());
      }

    // The rows of aggregates of other ranks are the last ones, in the order of ghost_targets():
    // they are sent block by block and then dropped here.
    std::map<unsigned int, std::vector<SentCoarseBlock>> messages;
    const unsigned int n_mine = coarse->locally_owned_size() / n_modes;
    unsigned int       row    = n_mine;
    for (const auto &[rank, n] : coarse->ghost_targets())
      {
        auto &to = messages[rank];
        for (const unsigned int end = row + n / n_modes; row < end; ++row)
          for (const auto &[aggregate, position] : parts[row].positions)
            {
              to.push_back({static_cast<Index>(global[row]), static_cast<Index>(aggregate), {}});
              const AggregateBlock &from = parts[row].blocks[position];
              to.back().entries          = from;
            }
      }
    parts.resize(n_mine);
    for (const auto &[rank, blocks] : exchange_records(messages, coarse->get_mpi_communicator()))
      for (const SentCoarseBlock &received : blocks)
        {
          // The transpose comes as well.
          if (symmetric && received.column < received.row &&
              coarse->in_local_range(n_modes * received.column))
            continue;
          AggregateRow   &to  = parts[coarse->global_to_local(n_modes * received.row) / n_modes];
          AggregateBlock &sum = to.at(static_cast<int>(received.column));
          for (unsigned int i = 0; i < sum.size(); ++i)
            sum[i] += received.entries[i];
        }
  }



  std::unique_ptr<BlockRows>
  Prolongation::galerkin(BlockRows &matrix, const bool symmetric) const
  {
    // Aggregates by local indices: those of the rows of this rank first, then what their
    // neighbours' rows refer to.
    std::vector<int> known;
    for (unsigned int i = 0; i < coarse->locally_owned_size() + coarse->n_ghost_indices();
         i += n_modes)
      known.push_back(static_cast<int>(coarse->local_to_global(i) / n_modes));
    const Epetra_Map known_map(-1, known.size(), known.data(), 0, coarse_kernel->Comm());
    LocalIndices     indices(known_map);
    auto             rows = part_of_galerkin(matrix, symmetric, indices);
    sum_up(rows, symmetric, indices.global());
    return std::make_unique<AggregateRows>(std::move(rows), symmetric, *coarse);
  }
} // namespace Touchstone
