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
   * @brief The rows of a square matrix, node by node as 3 x 3 blocks in double precision.
   *
   * Unknown 3 k + d is that of node k along d; each rank has whole nodes.
   */
  class BlockRows
  {
  public:
    /** @brief Entries (row, column) of a block are at 3 row + column. */
    using Block       = std::array<double, dim * dim>;
    using Partitioner = dealii::Utilities::MPI::Partitioner;

    virtual ~BlockRows() = default;

    /** @brief The rows of a node of this rank: nodes to which it is coupled, itself
     * included, by local number, and blocks. Valid until the next call. */
    virtual const RowOfBlocks<Block> &
    read(unsigned int node) = 0;

    /** @brief About as many blocks as all rows of this rank have. */
    virtual std::size_t
    n_blocks() const = 0;

    /** @brief Unknowns of this rank, and those of other ranks whose nodes its rows refer
     * to. */
    const std::shared_ptr<const Partitioner> &
    numbers() const
    {
      return partitioner;
    }

    unsigned int
    n_nodes() const
    {
      return partitioner->locally_owned_size() / dim;
    }

  protected:
    explicit BlockRows(std::shared_ptr<const Partitioner> partitioner)
      : partitioner(std::move(partitioner))
    {
    }

    const std::shared_ptr<const Partitioner> partitioner;
    /** The row that was read last. */
    RowOfBlocks<Block> present;
  };

  /** @brief The rows of a matrix over the displacements. */
  class MatrixRows : public BlockRows
  {
  public:
    /** @param matrix Must live as long; needs no FillComplete(). Collective. */
    explicit MatrixRows(const Epetra_CrsMatrix &matrix);

    const RowOfBlocks<Block> &
    read(unsigned int node) override;

    std::size_t
    n_blocks() const override;

  private:
    const Epetra_CrsMatrix &matrix;
    /** Local number of each column of the matrix. */
    std::vector<unsigned int> number;
  };

  /**
   * @brief A matrix in single precision, stored as 3 x 3 blocks of nodes: good enough for a preconditioner, whose speed is that of the memory.
   *
   * An entry takes 4.4 bytes instead of the 12 of a sparse matrix of double.
   */
  class BlockMatrix : public dealii::Subscriptor
  {
  public:
    using VectorType = dealii::LinearAlgebra::distributed::Vector<float>;
    using size_type  = dealii::types::global_dof_index;

    explicit BlockMatrix(BlockRows &rows);

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
