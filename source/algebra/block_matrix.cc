#include <touchstone/algebra/block_matrix.h>
#include <touchstone/vectorised.h>

#include <Epetra_MpiComm.h>
#include <algorithm>
#include <numeric>
#include <utility>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int block = dim * dim;

    /** Numbers a node in vectors whose nodes are to be loaded and stored whole. */
    constexpr unsigned int pad = 4;

    /** Four numbers in a register, from any address. (VectorizedArray of a deal.II that
     * was built for all processors has but one.) */
    using Lane __attribute__((vector_size(16), aligned(4), may_alias)) = float;

    /** Numbers that are read behind a block. */
    constexpr unsigned int unused = 1;

    /** The unknowns of this rank, and those of other ranks whose nodes the columns refer to. */
    std::shared_ptr<const Utilities::MPI::Partitioner>
    make_partitioner(const Epetra_CrsMatrix &matrix)
    {
      const Epetra_Map &rows = matrix.RowMap(), &columns = matrix.ColMap();
      const Index       size = matrix.NumGlobalRows();
      IndexSet          owned(size), ghosts(size);
      if (rows.NumMyElements() > 0)
        owned.add_range(rows.MinMyGID(), rows.MaxMyGID() + 1);
      std::vector<Index> far;
      for (int j = 0; j < columns.NumMyElements(); ++j)
        if (!owned.is_element(columns.GID(j)))
          for (unsigned int d = 0; d < dim; ++d)
            far.push_back(columns.GID(j) / dim * dim + d);
      std::sort(far.begin(), far.end());
      ghosts.add_indices(far.begin(), far.end());
      return std::make_shared<Utilities::MPI::Partitioner>(
        owned, ghosts, dynamic_cast<const Epetra_MpiComm &>(matrix.Comm()).Comm());
    }
  } // namespace



  MatrixRows::MatrixRows(const Epetra_CrsMatrix &matrix)
    : BlockRows(make_partitioner(matrix))
    , matrix(matrix)
    , number(matrix.NumMyCols())
  {
    for (unsigned int j = 0; j < number.size(); ++j)
      number[j] = partitioner->global_to_local(matrix.GCID(j));
  }



  std::size_t
  MatrixRows::n_blocks() const
  {
    // Almost all blocks are full. A matrix that is not complete does not know its nonzeros.
    std::size_t n_nonzeros = 0;
    for (int i = 0; i < matrix.NumMyRows(); ++i)
      n_nonzeros += matrix.NumMyEntries(i);
    return n_nonzeros / block * 11 / 10;
  }



  const RowOfBlocks<BlockRows::Block> &
  MatrixRows::read(const unsigned int node)
  {
    present.clear();
    int     n[dim] = {};
    double *value[dim];
    int    *local[dim];
    for (unsigned int d = 0; d < dim; ++d)
      matrix.ExtractMyRowView(dim * node + d, n[d], value[d], local[d]);
    // Three rows with the same columns, three after three: almost all are so.
    bool even = n[0] % dim == 0;
    for (unsigned int d = 1; d < dim; ++d)
      even = even && n[d] == n[0] && std::equal(local[0], local[0] + n[0], local[d]);
    for (int k = 0; even && k < n[0]; ++k)
      {
        const unsigned int place = k % int(dim), j = number[local[0][k]];
        even = j % dim == place && j - place == number[local[0][k - place]];
      }
    if (even)
      for (int k = 0; k < n[0]; k += dim)
        {
          Block &to = present.at(static_cast<int>(number[local[0][k]] / dim));
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int c = 0; c < dim; ++c)
              to[dim * d + c] += value[d][k + c];
        }
    else
      for (unsigned int d = 0; d < dim; ++d)
        for (int k = 0; k < n[d]; ++k)
          {
            const unsigned int j = number[local[d][k]];
            present.at(static_cast<int>(j / dim))[dim * d + j % dim] += value[d][k];
          }
    return present;
  }



  BlockMatrix::BlockMatrix(BlockRows &rows, const bool symmetric)
    : partitioner(rows.numbers())
  {
    const unsigned int        n_owned = rows.n_nodes();
    std::vector<unsigned int> order;
    start.reserve(n_owned + 1);
    start.push_back(0);
    mirrored.reserve(n_owned);
    const std::size_t n_blocks = symmetric ? rows.n_blocks() * 11 / 20 : rows.n_blocks();
    column.reserve(n_blocks);
    entries.reserve(block * n_blocks + unused);
    for (unsigned int node = 0; node < n_owned; ++node)
      {
        const auto &row = rows.read(node);
        order.clear();
        for (unsigned int k = 0; k < row.columns.size(); ++k)
          if (const unsigned int other = row.columns[k];
              !symmetric || other >= node || other >= n_owned)
            order.push_back(k);
        const auto twice = [&](const unsigned int k) {
          const unsigned int other = row.columns[k];
          return symmetric && other > node && other < n_owned;
        };
        std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
          return std::make_pair(!twice(a), row.columns[a]) <
                 std::make_pair(!twice(b), row.columns[b]);
        });
        mirrored.push_back(column.size() + std::count_if(order.begin(), order.end(), twice));
        for (const unsigned int k : order)
          {
            column.push_back(row.columns[k]);
            for (unsigned int c = 0; c < dim; ++c)
              for (unsigned int r = 0; r < dim; ++r)
                entries.push_back(static_cast<float>(row.blocks[k][dim * r + c]));
          }
        start.push_back(column.size());
      }
    // The last block is read beyond its end.
    for (unsigned int k = 0; k < unused; ++k)
      entries.push_back(0.f);
    padded_in.resize(pad * (n_owned + partitioner->n_ghost_indices() / dim));
    padded_out.resize(pad * n_owned);
  }



  TOUCHSTONE_VECTORISED void
  BlockMatrix::vmult(VectorType &result, const VectorType &x) const
  {
    x.update_ghost_values();
    const unsigned int n_local = padded_in.size() / pad;
    const float       *from    = x.begin();
    float             *in      = padded_in.begin();
    for (unsigned int node = 0; node < n_local; ++node)
      for (unsigned int d = 0; d < dim; ++d)
        in[pad * node + d] = from[dim * node + d];
    auto *const out = reinterpret_cast<Lane *>(padded_out.begin());
    std::fill(padded_out.begin(), padded_out.end(), 0.f);
    for (unsigned int node = 0; node < mirrored.size(); ++node)
      {
        // Three rows of the node and one that is not used: what fits into a register.
        Lane        sums[dim] = {};
        const float own[dim]  = {in[pad * node], in[pad * node + 1], in[pad * node + 2]};
        for (std::size_t k = start[node]; k < mirrored[node]; ++k)
          {
            const float *a = entries.data() + block * k;
            const float *y = in + pad * column[k];
            // Columns of the block, and rows of it. These from the registers: what limits
            // the speed are loads.
            const Lane a0 = *reinterpret_cast<const Lane *>(a),
                       a1 = *reinterpret_cast<const Lane *>(a + dim),
                       a2 = *reinterpret_cast<const Lane *>(a + 2 * dim);
            sums[0] += a0 * y[0];
            sums[1] += a1 * y[1];
            sums[2] += a2 * y[2];
            const Lane upper = __builtin_shufflevector(a0, a1, 0, 4, 1, 5),
                       lower = __builtin_shufflevector(a0, a1, 2, 6, 3, 7);
            out[column[k]] += __builtin_shufflevector(upper, a2, 0, 1, 4, 5) * own[0] +
                              __builtin_shufflevector(upper, a2, 2, 3, 5, 6) * own[1] +
                              __builtin_shufflevector(lower, a2, 0, 1, 6, 7) * own[2];
          }
        for (std::size_t k = mirrored[node]; k < start[node + 1]; ++k)
          {
            const float *a = entries.data() + block * k;
            const float *y = in + pad * column[k];
            for (unsigned int d = 0; d < dim; ++d)
              sums[d] += *reinterpret_cast<const Lane *>(a + dim * d) * y[d];
          }
        out[node] += sums[0] + sums[1] + sums[2];
      }
    float *to = result.begin();
    for (unsigned int node = 0; node < mirrored.size(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        to[dim * node + d] = padded_out[pad * node + d];
    x.zero_out_ghost_values();
  }



  float
  BlockMatrix::el(const size_type i, size_type) const
  {
    const unsigned int local = partitioner->global_to_local(i), node = local / dim;
    const auto begin = column.begin() + mirrored[node], end = column.begin() + start[node + 1];
    const auto found = std::lower_bound(begin, end, node);
    return entries[block * (found - column.begin()) + (dim + 1) * (local % dim)];
  }



  BlockMatrix::VectorType
  BlockMatrix::inverse_diagonal() const
  {
    VectorType result;
    initialize_vector(result);
    for (const size_type i : partitioner->locally_owned_range())
      result(i) = 1.f / el(i, i);
    return result;
  }



  BlockMatrix::Rows::Rows(const BlockMatrix &matrix)
    : matrix(matrix)
    , start(matrix.n_nodes() + 1, 0)
  {
    for (unsigned int node = 0; node < matrix.n_nodes(); ++node)
      for (std::size_t k = matrix.start[node]; k < matrix.mirrored[node]; ++k)
        ++start[matrix.column[k] + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    mirrors.resize(start.back());
    std::vector<std::size_t> next(start);
    for (unsigned int node = 0; node < matrix.n_nodes(); ++node)
      for (std::size_t k = matrix.start[node]; k < matrix.mirrored[node]; ++k)
        mirrors[next[matrix.column[k]]++] = {node, k};
  }



  const BlockMatrix::Rows::Row &
  BlockMatrix::Rows::read(const unsigned int node)
  {
    present.columns.clear();
    present.blocks.clear();
    for (std::size_t m = start[node]; m < start[node + 1]; ++m)
      {
        present.columns.push_back(mirrors[m].first);
        present.blocks.emplace_back();
        const float *a = matrix.entries.data() + block * mirrors[m].second;
        for (unsigned int r = 0; r < dim; ++r)
          for (unsigned int c = 0; c < dim; ++c)
            present.blocks.back()[dim * c + r] = a[dim * r + c];
      }
    for (std::size_t k = matrix.start[node]; k < matrix.start[node + 1]; ++k)
      {
        present.columns.push_back(matrix.column[k]);
        present.blocks.emplace_back();
        std::copy_n(matrix.entries.data() + block * k, block, present.blocks.back().begin());
      }
    return present;
  }
} // namespace Touchstone
