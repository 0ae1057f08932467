// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/block_matrix.h>

#include <Epetra_MpiComm.h>
#include <algorithm>

// Rows of a sparse matrix of scalars, read as 3 x 3 blocks of nodes.
namespace Touchstone
{
  using namespace dealii;

  // The partitioner of the dofs: all three dofs of a node of another rank become ghosts, even if
  // only one is a column, since the columns of a block are addressed through the node.
  std::shared_ptr<const BlockRows::Partitioner>
  BlockRows::number(const Epetra_Map &rows, const int *const columns, const std::size_t n_columns)
  {
    const Index size = rows.NumGlobalElements();
    IndexSet    owned(size), ghosts(size);
    if (rows.NumMyElements() > 0)
      owned.add_range(rows.MinMyGID(), rows.MaxMyGID() + 1);
    std::vector<Index> far;
    for (std::size_t j = 0; j < n_columns; ++j)
      if (!owned.is_element(columns[j]))
        for (unsigned int d = 0; d < dim; ++d)
          far.push_back(columns[j] / dim * dim + d);
    // Sorted first: IndexSet would insert single indices one by one, at quadratic cost.
    std::sort(far.begin(), far.end());
    ghosts.add_indices(far.begin(), far.end());
    return std::make_shared<Partitioner>(owned,
                                         ghosts,
                                         dynamic_cast<const Epetra_MpiComm &>(rows.Comm()).Comm());
  }



  MatrixRows::MatrixRows(const Epetra_CrsMatrix &matrix)
    : BlockRows(number(matrix.RowMap(),
                       matrix.ColMap().MyGlobalElements(),
                       matrix.ColMap().NumMyElements()))
    , matrix(matrix)
    , local_number(matrix.NumMyCols())
  {
    for (unsigned int j = 0; j < local_number.size(); ++j)
      local_number[j] = partitioner->global_to_local(matrix.GCID(j));
  }



  std::size_t
  MatrixRows::n_blocks() const
  {
    // Almost all blocks are full, 10 % allow for those that are not. NumMyNonzeros() would need
    // FillComplete().
    std::size_t n_nonzeros = 0;
    for (int i = 0; i < matrix.NumMyRows(); ++i)
      n_nonzeros += matrix.NumMyEntries(i);
    return n_nonzeros / (dim * dim) * 11 / 10;
  }



  // The entries of three scalar rows as blocks of nodes. Rows of a node usually have the same
  // columns, in whole nodes; then blocks are found once for three entries. Where constraints have
  // taken single columns away, each entry is sorted in by itself.
  const RowOfBlocks<BlockRows::Block> &
  MatrixRows::read(const unsigned int node)
  {
    present.clear();
    int     n[dim] = {};
    double *value[dim];
    int    *local[dim];
    for (unsigned int d = 0; d < dim; ++d)
      matrix.ExtractMyRowView(dim * node + d, n[d], value[d], local[d]);
    // Whether the three rows have the same columns, in whole nodes (x, y, z of a node in
    // succession).
    bool even = n[0] % dim == 0;
    for (unsigned int d = 1; d < dim; ++d)
      even = even && n[d] == n[0] && std::equal(local[0], local[0] + n[0], local[d]);
    for (int k = 0; even && k < n[0]; ++k)
      {
        const unsigned int place = k % int(dim), j = local_number[local[0][k]];
        even = j % dim == place && j - place == local_number[local[0][k - place]];
      }
    if (even)
      for (int k = 0; k < n[0]; k += dim)
        {
          Block &to = present.at(static_cast<int>(local_number[local[0][k]] / dim));
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int c = 0; c < dim; ++c)
              to[dim * d + c] += value[d][k + c];
        }
    else
      for (unsigned int d = 0; d < dim; ++d)
        for (int k = 0; k < n[d]; ++k)
          {
            const unsigned int j = local_number[local[d][k]];
            present.at(static_cast<int>(j / dim))[dim * d + j % dim] += value[d][k];
          }
    return present;
  }
} // namespace Touchstone
