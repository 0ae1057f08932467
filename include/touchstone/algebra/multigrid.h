#ifndef touchstone_algebra_multigrid_h
#define touchstone_algebra_multigrid_h

#include <touchstone/algebra/block_matrix.h>
#include <touchstone/algebra/prolongation.h>
#include <touchstone/algebra/square_operator.h>

#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/precondition.h>

#include <Epetra_Vector.h>
#include <memory>
#include <ml_MultiLevelPreconditioner.h>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Multigrid by smoothed aggregation, for systems of displacements. The finest level,
   * where most of the time and of the memory goes, works in single precision on 3 x 3
   * blocks; ML has the levels below.
   *
   * Vanek, Mandel and Brezina (1996), Computing 56; smoothing by Chebyshev polynomials:
   * Adams, Brezina, Hu and Tuminaro (2003), J. Comput. Phys. 188.
   */
  class Multigrid : public SquareOperator
  {
  public:
    /**
     * @param matrix        Kept where ML has all levels, for which it is completed if it is
     *                      not.
     * @param near_kernel   Motions with little or no energy that the coarse levels must be
     *                      able to represent, zero at constrained unknowns.
     * @param body          Body of each row of this rank: aggregates() are within one.
     * @param coarse_levels Whether to make any; without them a sweep of symmetric
     *                      Gauss-Seidel is all.
     */
    Multigrid(std::shared_ptr<Epetra_CrsMatrix> matrix,
              const Epetra_MultiVector         &near_kernel,
              const std::vector<unsigned int>  &body,
              bool                              coarse_levels);

    /** @brief One V-cycle from zero, for each vector. Collective. */
    int
    ApplyInverse(const Epetra_MultiVector &rhs, Epetra_MultiVector &result) const override;

  private:
    using VectorType = BlockMatrix::VectorType;
    using Chebyshev =
      dealii::PreconditionChebyshev<BlockMatrix, VectorType, dealii::DiagonalMatrix<VectorType>>;

    /** The finest level, unless ML has all of them. */
    std::unique_ptr<BlockMatrix>  fine_matrix;
    std::unique_ptr<Chebyshev>    smoother;
    std::unique_ptr<Prolongation> prolongation;
    /** What ML works on: the first of the coarse levels, or the matrix itself. */
    std::shared_ptr<Epetra_CrsMatrix>                    matrix;
    std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> hierarchy;
    /** Work space of a cycle. */
    mutable VectorType             fine_rhs, fine_solution, fine_residual, coarse_values;
    std::unique_ptr<Epetra_Vector> coarse_rhs, coarse_solution;

    /** @brief The finest level and the matrix of the next. */
    void
    make_finest_level(const Epetra_MultiVector        &near_kernel,
                      const std::vector<unsigned int> &body_of_nodes);
    void
    make_hierarchy(const Teuchos::ParameterList    &list,
                   const std::vector<unsigned int> &body_of_nodes);
    void
    cycle(const double *rhs, double *result) const;
  };
} // namespace Touchstone

#endif
