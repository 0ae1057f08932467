#ifndef touchstone_algebra_block_matrix_h
#define touchstone_algebra_block_matrix_h

#include <touchstone/types.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/partitioner.h>
#include <deal.II/base/subscriptor.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <Epetra_CrsMatrix.h>
#include <memory>
#include <vector>

namespace Touchstone
{
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

    /** @param matrix Rows and columns are displacements, unknown 3 k + d of node k
     * along d; each rank has whole nodes. */
    explicit BlockMatrix(const Epetra_CrsMatrix &matrix);

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
