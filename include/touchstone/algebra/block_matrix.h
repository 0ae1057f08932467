// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_block_matrix_h
#define touchstone_algebra_block_matrix_h

#include <touchstone/algebra/block_pattern.h>
#include <touchstone/algebra/multigrid/row_of_blocks.h>
#include <touchstone/base/types.h>

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
   * Dof 3 k + d is that of node k along d; each rank has whole nodes.
   */
  class BlockRows
  {
  public:
    /** @brief Entries (row, column) of a block are at 3 row + column. */
    using Block       = std::array<double, dim * dim>;
    using Partitioner = dealii::Utilities::MPI::Partitioner;

    virtual ~BlockRows() = default;

    /** @brief The rows of a node of this rank: nodes to which it is coupled, itself
     * included, by local index, and blocks. Valid until the next call. Rows of a symmetric
     * matrix need not have blocks of earlier nodes of this rank, of which those nodes' rows
     * have the transposes; who reads them looks at the others only. */
    virtual const RowOfBlocks<Block> &
    read(unsigned int node) = 0;

    /** @brief These rows will not be read again: what they alone need may be freed. */
    virtual void
    forget(unsigned int /*node*/)
    {
    }

    /** @brief About as many blocks as all rows of this rank have, if they are whole. */
    virtual std::size_t
    n_blocks() const = 0;

    /** @brief Dofs of this rank, and those of other ranks whose nodes its rows refer
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

    /** @brief Numbers for the dofs of this rank, and those of other ranks whose nodes
     * the columns, by global indices, refer to. Collective. */
    static std::shared_ptr<const Partitioner>
    number(const Epetra_Map &rows, const int *columns, std::size_t n_columns);

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
    /** Local index of each column of the matrix. */
    std::vector<unsigned int> local_number;
  };

  /**
   * @brief A matrix stored as 3 x 3 blocks of nodes. What limits products is the memory, of
   * which a symmetric matrix takes half, for each block between two nodes of a rank is
   * stored once: an entry takes 2.3 bytes in single precision, which is good enough for
   * a preconditioner, and 4.4 in double, instead of the 12 of a sparse matrix of double.
   */
  template <typename Number>
  class BlockMatrix : public dealii::Subscriptor
  {
  public:
    using VectorType = dealii::LinearAlgebra::distributed::Vector<Number>;
    using size_type  = dealii::types::global_dof_index;

    /** @brief Empty. */
    BlockMatrix() = default;

    /** @param symmetric Of two blocks that are transposes of each other one is read and stored. */
    BlockMatrix(BlockRows &rows, bool symmetric);

    /** @brief The layout of vectors that can be multiplied. */
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &
    vector_partitioner() const
    {
      return pattern->partitioner;
    }

    /** @brief Give @p vector the layout of the rows, with ghosts; its values are not set. */
    void
    initialize_vector(VectorType &vector) const
    {
      vector.reinit(pattern->partitioner);
    }

    size_type
    m() const
    {
      return pattern->partitioner->size();
    }

    /** @brief Nodes of this rank. */
    unsigned int
    n_nodes() const
    {
      return pattern->n_nodes();
    }

    /** @brief result = A x. Collective. */
    void
    vmult(VectorType &result, const VectorType &x) const
    {
      multiply(result.begin(), x.begin());
    }

    /** @brief The same for the dofs of this rank as plain arrays, which must not
     * overlap. Collective. */
    void
    multiply(Number *result, const Number *x) const;

    /** @brief Free the work space of products, which takes more memory than a vector; the next
     * product makes it again. */
    void
    free_work_space() const
    {
      padded_out.clear();
      with_ghosts.clear();
    }

    /** @brief An entry of the diagonal, by local index of the row. */
    Number
    diagonal(const unsigned int row) const
    {
      return entries[dim * dim * pattern->diagonal(row / dim) + (dim + 1) * (row % dim)];
    }

    /** @brief The same. @param i Number of the row, of this rank. */
    Number
    el(const size_type i, size_type) const
    {
      return diagonal(pattern->partitioner->global_to_local(i));
    }

    /** @brief One over the diagonal. */
    VectorType
    inverse_diagonal() const;

    /** @brief The whole rows of a matrix, those blocks included that it has as others'
     * transposes. */
    class Rows
    {
    public:
      /** @brief Nodes to which a node is coupled, itself included, by local index in
       * ascending order, and blocks, column by column. */
      struct Row
      {
        std::vector<unsigned int>                  columns;
        std::vector<std::array<Number, dim * dim>> blocks;
      };

      /** @param matrix Must live as long, and keep its entries. */
      explicit Rows(const BlockMatrix &matrix)
        : matrix(matrix)
      {
      }

      /** @brief The row of a node of this rank; valid until another one is read. Repeated calls
       * for the same node, one for each of its dofs, assemble the row once. */
      const Row &
      read(unsigned int node);

      /** @brief The same without blocks that other rows store as transposes. */
      const Row &
      read_stored(unsigned int node);

      /** @brief Blocks in the whole row of a node. */
      unsigned int
      length(unsigned int node);

    private:
      const BlockMatrix &matrix;
      Row                present;
      unsigned int       present_node = dealii::numbers::invalid_unsigned_int;
      /** Of the pattern, from the first whole row on. */
      std::shared_ptr<const BlockPattern::TransposedBlocks> transposed;

      /** Row pointers of the transposed blocks of a node. */
      std::pair<std::size_t, std::size_t>
      transposed_range(unsigned int node);

      /** Append the blocks that the row of a node stores. */
      void
      append_stored(unsigned int node);
    };

  protected:
    std::shared_ptr<const BlockPattern> pattern;
    /** Of the blocks of the pattern, column by column, and one more number, since a register
     * of four is loaded for the last column of three. */
    dealii::AlignedVector<Number> entries;

    /** Allocate what is exchanged in products and, unless they exist, the entries as zeros. */
    void
    allocate();

  private:
    /** Result of a product, padded to four numbers a node: a register of four numbers written to
     * one node would otherwise overwrite the first number of the next. The factor with the numbers
     * received from other ranks behind it, if there are any; and those sent to them. */
    mutable dealii::AlignedVector<Number> padded_out, with_ghosts, imported;
  };
} // namespace Touchstone

#endif
