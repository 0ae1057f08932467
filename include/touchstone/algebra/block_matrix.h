#ifndef touchstone_algebra_block_matrix_h
#define touchstone_algebra_block_matrix_h

#include <touchstone/algebra/row_of_blocks.h>
#include <touchstone/types.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/partitioner.h>
#include <deal.II/base/subscriptor.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <Epetra_CrsMatrix.h>
#include <array>
#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The rows of a matrix over the displacements, node by node as 3 x 3 blocks.
   */
  class BlockRows
  {
  public:
    /** @brief Entries (row, column) of a block are at 3 row + column. */
    using Block = std::array<double, dim * dim>;

    /** @param matrix     Rows and columns are displacements, unknown 3 k + d of node k
     *                    along d; each rank has whole nodes. Must live as long.
     *  @param partitioner Local numbers: of make_partitioner(). */
    BlockRows(const Epetra_CrsMatrix                    &matrix,
              const dealii::Utilities::MPI::Partitioner &partitioner);

    /** @brief The rows of a node of this rank: nodes to which it is coupled, itself
     * included, by local number, and blocks. Valid until the next call. */
    const RowOfBlocks<Block> &
    read(unsigned int node);

    unsigned int
    n_nodes() const
    {
      return matrix.NumMyRows() / dim;
    }

    /** @brief Unknowns of this rank, and those of other ranks whose nodes the rows of a
     * matrix refer to. Collective. */
    static std::shared_ptr<const dealii::Utilities::MPI::Partitioner>
    make_partitioner(const Epetra_CrsMatrix &matrix);

  private:
    const Epetra_CrsMatrix &matrix;
    /** Local number of each column of the matrix. */
    std::vector<unsigned int> number;
    RowOfBlocks<Block>        present;
  };

  /**
   * @brief A matrix over the displacements in single precision, stored as 3 x 3 blocks of
   * nodes: good enough for a preconditioner, whose speed is that of the memory.
   *
   * An entry takes 4.4 bytes instead of the 12 of a sparse matrix of double.
   */
  class BlockMatrix : public dealii::Subscriptor
  {
  public:
    using VectorType = dealii::LinearAlgebra::distributed::Vector<float>;
    using size_type  = dealii::types::global_dof_index;

    /** @param matrix As BlockRows takes it. */
    explicit BlockMatrix(const Epetra_CrsMatrix &matrix);

    /** @brief Of vectors that fit. */
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &
    vector_partitioner() const
    {
      return partitioner;
    }

    /** @brief Make @p vector fit, with ghosts; its values are not set. */
    void
    initialize_vector(VectorType &vector) const
    {
      vector.reinit(partitioner);
    }

    size_type
    m() const
    {
      return partitioner->size();
    }

    /** @brief The rows of a node of this rank: nodes to which it is coupled in ascending
     * order, by local number, and blocks, column by column. */
    struct Row
    {
      const unsigned int *columns;
      std::size_t         size;
      const float        *entries;

      /** @brief Entry (r, c) of block @p k. */
      float
      operator()(const std::size_t k, const unsigned int r, const unsigned int c) const
      {
        return entries[dim * dim * k + dim * c + r];
      }
    };

    Row
    row(const unsigned int node) const
    {
      return {column.data() + start[node],
              start[node + 1] - start[node],
              entries.data() + dim * dim * start[node]};
    }

    unsigned int
    n_nodes() const
    {
      return start.size() - 1;
    }

    /** @brief result = A x. Collective. */
    void
    vmult(VectorType &result, const VectorType &x) const;

    /** @brief An entry of the diagonal of a row of this rank. @param i Number of the row. */
    float
    el(size_type i, size_type) const;

    /** @brief One over the diagonal. */
    VectorType
    inverse_diagonal() const;

  private:
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
    /** Where the blocks of a node begin; their column, a local node; their entries,
     * column by column. */
    std::vector<std::size_t>     start;
    std::vector<unsigned int>    column;
    dealii::AlignedVector<float> entries;
  };
} // namespace Touchstone

#endif
