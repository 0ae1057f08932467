// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_multigrid_multigrid_h
#define touchstone_algebra_multigrid_multigrid_h

#include <touchstone/algebra/block_matrix.h>
#include <touchstone/algebra/multigrid/prolongation.h>
#include <touchstone/algebra/square_operator.h>

#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/precondition.h>

#include <Amesos_BaseSolver.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_Vector.h>
#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Multigrid by smoothed aggregation, for systems of displacements.
   *
   * All levels work in single precision on 3 x 3 blocks, since the memory bandwidth bounds their
   * speed; the coarsest system, of few dofs, is solved directly (KLU, by Amesos).
   *
   * Vanek, Mandel and Brezina (1996), Computing 56; smoothing by Chebyshev polynomials:
   * Adams, Brezina, Hu and Tuminaro (2003), J. Comput. Phys. 188.
   */
  class Multigrid : public SquareOperator
  {
  public:
    /**
     * @param map         Of the dofs.
     * @param rows        The matrix, read here and not kept.
     * @param near_kernel Motions with little or no energy that the coarse levels must be
     *                    able to represent, zero at constrained dofs.
     * @param body        Body of each row of this rank: aggregates() are within one.
     * @param symmetric   The matrix is, and half of it is enough.
     * @throws LinearSolverFailure if the coarsest level is singular, or a level is indefinite or
     *         not finite, on all ranks.
     */
    Multigrid(const Epetra_Map                &map,
              std::unique_ptr<BlockRows>       rows,
              Prolongation::NearKernel         near_kernel,
              const std::vector<unsigned int> &body,
              bool                             symmetric);

    /** @brief One V-cycle from zero, for each vector. Collective. */
    int
    ApplyInverse(const Epetra_MultiVector &rhs, Epetra_MultiVector &result) const override;

  private:
    using VectorType = BlockMatrix<float>::VectorType;
    using Chebyshev  = dealii::
      PreconditionChebyshev<BlockMatrix<float>, VectorType, dealii::DiagonalMatrix<VectorType>>;

    struct Level
    {
      Level(BlockRows &rows, bool symmetric);

      /** Estimates the largest eigenvalue by so many @p iterations; none: it is @p eigenvalue. */
      void
      make_smoother(Chebyshev &result, unsigned int iterations, double eigenvalue) const;

      BlockMatrix<float> matrix;
      Chebyshev          smoother;
      /** Largest one of the matrix over its diagonal, as deal.II bounds it. */
      double eigenvalue = 0.;
      /** To the next level, if there is one. */
      std::unique_ptr<Prolongation> prolongation;
      /** Work space of a cycle. */
      VectorType rhs, solution, residual, coarse_values;
    };

    std::vector<std::unique_ptr<Level>> levels;

    /** The coarsest level, which is solved directly. */
    std::unique_ptr<Epetra_CrsMatrix>  coarsest_matrix;
    std::unique_ptr<Epetra_Vector>     coarsest_rhs, coarsest_solution;
    Epetra_LinearProblem               coarsest_problem;
    std::unique_ptr<Amesos_BaseSolver> coarsest;

    /** @brief Of the matrix of a level over its diagonal. @throws LinearSolverFailure if there is
     * none, on all ranks. */
    static double
    largest_eigenvalue(Level &level);

    void
    make_work_space();

    void
    make_coarsest(BlockRows &rows, bool symmetric);

    /** @brief One cycle from level @p k on, over the dofs of this rank; @p rhs and @p
     * solution may be the same. */
    template <typename Number>
    void
    cycle(unsigned int k, const Number *rhs, Number *solution) const;
  };
} // namespace Touchstone

#endif
