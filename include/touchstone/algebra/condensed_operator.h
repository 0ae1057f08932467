// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_condensed_operator_h
#define touchstone_algebra_condensed_operator_h

#include <touchstone/algebra/block_matrix.h>
#include <touchstone/algebra/condensation.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Operator.h>
#include <Epetra_Vector.h>
#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The matrix S^T A T of a condensed system, with units, in the forms that Krylov
   * methods, preconditioners and factorisations need: assembled once
   * (AssembledOperator) or applied factor by factor (AppliedOperator).
   */
  class CondensedOperator
  {
  public:
    virtual ~CondensedOperator() = default;

    /** @brief What multiplies a solution. */
    virtual Epetra_Operator &
    product() = 0;

    /** @brief The right-hand side S^T (b - A g). Collective. */
    virtual std::unique_ptr<Epetra_Vector>
    right_hand_side() const = 0;

    /** @brief The matrix as rows; keep it no longer than needed, for it may be
     * assembled anew in each call. Collective. */
    virtual std::shared_ptr<Epetra_CrsMatrix>
    matrix() const = 0;

    /** @brief The same to be read node by node; of displacements only, and half of a symmetric
     * matrix (BlockRows::read()). Collective. */
    virtual std::unique_ptr<BlockRows>
    block_rows() const = 0;
  };

  /** @brief S^T A T as plain distributed rows: those of the stiffness, or what
   * Condensation puts in their place. Collective.
   * @param values Right-hand side of this rank without units, if not null. */
  std::shared_ptr<Epetra_CrsMatrix>
  assemble_condensed_matrix(const CondensationInput &input, std::vector<double> *values);

  /** @brief The same rows as 3 x 3 blocks, of a symmetric matrix half of them
   * (BlockRows::read()). Collective. */
  std::unique_ptr<BlockRows>
  condensed_block_rows(const CondensationInput &input);

  /** @brief The matrix assembled once, for solvers that factorise it. */
  class AssembledOperator : public CondensedOperator
  {
  public:
    /** @brief Collective. */
    explicit AssembledOperator(const CondensationInput &input);

    Epetra_Operator &
    product() override
    {
      return *entries;
    }

    std::unique_ptr<Epetra_Vector>
    right_hand_side() const override
    {
      return std::make_unique<Epetra_Vector>(*rhs);
    }

    std::shared_ptr<Epetra_CrsMatrix>
    matrix() const override
    {
      return entries;
    }

    std::unique_ptr<BlockRows>
    block_rows() const override
    {
      return std::make_unique<MatrixRows>(*entries);
    }

  private:
    std::shared_ptr<Epetra_CrsMatrix> entries;
    std::unique_ptr<Epetra_Vector>    rhs;
  };
} // namespace Touchstone

#endif
