// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_applied_operator_h
#define touchstone_algebra_applied_operator_h

#include <touchstone/algebra/condensed_operator.h>
#include <touchstone/algebra/square_operator.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Vector.h>
#include <memory>
#include <utility>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The condensed matrix S^T (A + D + C) T applied factor by factor: the
   * continuum stiffness A as it is, beside it the shift D of its diagonal, the
   * contact terms C, and the transformations T and S, which are small
   * (doc/theory.md, section 7).
   *
   * Nothing is assembled when contact changes. Constrained dofs keep the diagonal
   * entry of the stiffness.
   */
  class AppliedOperator : public SquareOperator, public CondensedOperator
  {
  public:
    /** @brief Collective. */
    explicit AppliedOperator(const CondensationInput &input);

    Epetra_Operator &
    product() override
    {
      return *this;
    }

    std::unique_ptr<Epetra_Vector>
    right_hand_side() const override;

    std::shared_ptr<Epetra_CrsMatrix>
    matrix() const override
    {
      return assemble_condensed_matrix(input, nullptr);
    }

    std::unique_ptr<BlockRows>
    block_rows() const override
    {
      // Multigrid is set up, which takes most memory of a run.
      all.reset();
      return condensed_block_rows(input);
    }

    int
    Apply(const Epetra_MultiVector &x, Epetra_MultiVector &result) const override;

  private:
    const CondensationInput input;
    /** The contact terms C = L^T R, a row for each of this rank; null without
     * any. And what R gives, as the elongations of springs. */
    std::unique_ptr<Epetra_CrsMatrix> left, right;
    std::unique_ptr<Epetra_Vector>    elongations;
    /** Forces of springs; null without any. */
    std::unique_ptr<Epetra_Vector> part;
    /** Constrained dofs, and their entries on the diagonal. */
    std::vector<std::pair<int, double>> diagonal;
    /** Work space of products, made when it is needed. */
    mutable std::unique_ptr<Epetra_Vector> all;

    /** Forms of this rank's terms as the rows of a matrix. */
    std::unique_ptr<Epetra_CrsMatrix>
    forms(LinearForm RankOneTerm::*side) const;

    /** result = (A + D + C) x, of all dofs. */
    void
    multiply(const Epetra_Vector &x, Epetra_Vector &result) const;
  };
} // namespace Touchstone

#endif
