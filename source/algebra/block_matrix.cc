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

    /** Four numbers in a register, from any address. (VectorizedArray of a deal.II that
     * was built for all processors has but one.) */
    using Lane __attribute__((vector_size(16), aligned(4), may_alias)) = float;

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



  BlockMatrix::BlockMatrix(BlockRows &rows)
    : partitioner(rows.numbers())
  {
    std::vector<unsigned int> order;
    start.reserve(rows.n_nodes() + 1);
    start.push_back(0);
    const std::size_t n_blocks = rows.n_blocks();
    column.reserve(n_blocks);
    entries.reserve(block * n_blocks + 1);
    for (unsigned int node = 0; node < rows.n_nodes(); ++node)
      {
        const auto &row = rows.read(node);
        order.resize(row.columns.size());
        std::iota(order.begin(), order.end(), 0U);
        std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
          return row.columns[a] < row.columns[b];
        });
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
    entries.push_back(0.f);
  }



  TOUCHSTONE_VECTORISED void
  BlockMatrix::vmult(VectorType &result, const VectorType &x) const
  {
    x.update_ghost_values();
    const float       *in      = x.begin();
    float             *out     = result.begin();
    const unsigned int n_nodes = start.size() - 1;
    for (unsigned int node = 0; node < n_nodes; ++node)
      {
        // Three rows of the node and one that is not used: what fits into a register.
        Lane sums[dim] = {};
        for (std::size_t k = start[node]; k < start[node + 1]; ++k)
          {
            const float *a = entries.data() + block * k;
            const float *y = in + dim * column[k];
            for (unsigned int d = 0; d < dim; ++d)
              sums[d] += *reinterpret_cast<const Lane *>(a + dim * d) * y[d];
          }
        const Lane sum = sums[0] + sums[1] + sums[2];
        for (unsigned int row = 0; row < dim; ++row)
          out[dim * node + row] = sum[row];
      }
    x.zero_out_ghost_values();
  }



  float
  BlockMatrix::el(const size_type i, size_type) const
  {
    const unsigned int local = partitioner->global_to_local(i), node = local / dim;
    const auto         begin = column.begin() + start[node], end = column.begin() + start[node + 1];
    const auto         found = std::lower_bound(begin, end, node);
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
} // namespace Touchstone
