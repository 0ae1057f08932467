// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_multigrid_block_diagonal_h
#define touchstone_algebra_multigrid_block_diagonal_h

#include <touchstone/algebra/block_matrix.h>
#include <touchstone/algebra/square_operator.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief The inverse of the diagonal 3 x 3 blocks of a matrix, one a node: the block
   * Jacobi preconditioner, to compare with published work that scales by the diagonal.
   */
  class BlockDiagonal : public SquareOperator
  {
  public:
    /**
     * @param map  Of the dofs.
     * @param rows The matrix, read here and not kept.
     * @throws LinearSolverFailure if a block is singular, on all ranks.
     */
    BlockDiagonal(const Epetra_Map &map, BlockRows &rows);

    int
    ApplyInverse(const Epetra_MultiVector &rhs, Epetra_MultiVector &result) const override;

  private:
    std::vector<BlockRows::Block> inverse;
  };
} // namespace Touchstone

#endif
