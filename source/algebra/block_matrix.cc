#include <touchstone/algebra/block_matrix.h>

#include <Epetra_MpiComm.h>
#include <algorithm>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int block = dim * dim;

    /** Four numbers in a register, from any address. (VectorizedArray of a deal.II that
     * was built for all processors has but one.) */
    using Lane __attribute__((vector_size(16), aligned(4), may_alias)) = float;

    /** Unknowns of this rank, and those of other ranks whose nodes its rows refer to. */
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



  BlockMatrix::BlockMatrix(const Epetra_CrsMatrix &matrix)
    : partitioner(make_partitioner(matrix))
  {
    const Epetra_Map         &columns = matrix.ColMap();
    std::vector<unsigned int> place(columns.NumMyElements());
    for (int j = 0; j < columns.NumMyElements(); ++j)
      place[j] = partitioner->global_to_local(columns.GID(j));

    const unsigned int n_nodes = matrix.NumMyRows() / dim;
    // Which blocks there are, then what is in them: rows of a node may differ in length.
    std::vector<unsigned int> seen(
      (partitioner->locally_owned_size() + partitioner->n_ghost_indices()) / dim,
      numbers::invalid_unsigned_int);
    start.reserve(n_nodes + 1);
    start.push_back(0);
    const auto for_each_entry = [&](const unsigned int node, const auto &visit) {
      for (unsigned int d = 0; d < dim; ++d)
        {
          int     n;
          double *value;
          int    *local;
          matrix.ExtractMyRowView(dim * node + d, n, value, local);
          for (int k = 0; k < n; ++k)
            visit(d, place[local[k]], value[k]);
        }
    };
    for (unsigned int node = 0; node < n_nodes; ++node)
      {
        for_each_entry(node, [&](unsigned int, const unsigned int j, double) {
          if (seen[j / dim] != node)
            {
              seen[j / dim] = node;
              column.push_back(j / dim);
            }
        });
        std::sort(column.begin() + start.back(), column.end());
        start.push_back(column.size());
      }
    // The last block is read beyond its end.
    entries.resize(block * column.size() + 1, 0.f);
    for (unsigned int node = 0; node < n_nodes; ++node)
      {
        for (std::size_t k = start[node]; k < start[node + 1]; ++k)
          seen[column[k]] = k - start[node];
        for_each_entry(node, [&](const unsigned int d, const unsigned int j, const double value) {
          entries[block * (start[node] + seen[j / dim]) + dim * (j % dim) + d] +=
            static_cast<float>(value);
        });
      }
  }



  void
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
