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
#include <utility>
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
   * @brief A matrix in single precision, stored as 3 x 3 blocks of nodes: good enough for a
   * preconditioner, whose speed is that of the memory.
   *
   * Of a symmetric matrix each block between two nodes of a rank is stored once: an entry
   * takes 2.3 bytes, 4.4 if it is not symmetric, instead of the 12 of a sparse matrix of
   * double.
   */
  class BlockMatrix : public dealii::Subscriptor
  {
  public:
    using VectorType = dealii::LinearAlgebra::distributed::Vector<float>;
    using size_type  = dealii::types::global_dof_index;

    /** @param symmetric Of each two blocks that are transposes of each other one counts. */
    BlockMatrix(BlockRows &rows, bool symmetric);

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

    unsigned int
    n_nodes() const
    {
      return mirrored.size();
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

    /** @brief The whole rows of a matrix, those blocks included that it has as others'
     * transposes. */
    class Rows
    {
    public:
      /** @brief Nodes to which a node is coupled, itself included, by local number, and
       * blocks, column by column. */
      struct Row
      {
        std::vector<unsigned int>                 columns;
        std::vector<std::array<float, dim * dim>> blocks;
      };

      /** @param matrix Must live as long. */
      explicit Rows(const BlockMatrix &matrix);

      /** @brief Of a node of this rank; valid until the next call. */
      const Row &
      read(unsigned int node);

    private:
      const BlockMatrix &matrix;
      /** Where the blocks that mirror others begin, of each node; node and place of these. */
      std::vector<std::size_t>                          start;
      std::vector<std::pair<unsigned int, std::size_t>> mirrors;
      Row                                               present;
    };

  private:
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
    /** Where the blocks of a node begin, first those whose transposes are blocks as well;
     * where these end; the columns of blocks, local nodes; entries, column by column. */
    std::vector<std::size_t>     start, mirrored;
    std::vector<unsigned int>    column;
    dealii::AlignedVector<float> entries;
    /** Vectors of a product, four numbers a node: of three, one node's would overlap in the
     * registers with the next one's, which is being written. */
    mutable dealii::AlignedVector<float> padded_in, padded_out;
  };
} // namespace Touchstone

#endif
