#ifndef touchstone_algebra_applied_operator_h
#define touchstone_algebra_applied_operator_h

#include <touchstone/algebra/condensation.h>
#include <touchstone/algebra/square_operator.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Vector.h>
#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief A linear system with its constraints condensed out, S^T (A + D + C) T, applied
   * factor by factor: the continuum stiffness A as it is, beside it the shift D of its
   * diagonal, the contact terms C, and the constraints T and S, which are small.
   *
   * Nothing is assembled when contact changes. Constrained unknowns keep the diagonal
   * entry of the stiffness.
   */
  class AppliedOperator : public SquareOperator
  {
  public:
    /**
     * @param system      Must live as long.
     * @param rows        Unknowns of this rank, extra ones last.
     * @param constrained Marks rows of constrained unknowns.
     * @param scale       Of the unknowns and of the equations; may be null.
     */
    AppliedOperator(const LinearSystem      &system,
                    const Epetra_Map        &rows,
                    const std::vector<char> &constrained,
                    const Epetra_Vector     *scale);

    /** @brief Right-hand side S^T (b - (A + D + C) g). Collective. */
    std::unique_ptr<Epetra_Vector>
    right_hand_side() const;

    /** @brief result = T y + g. Collective. */
    void
    expand(const Epetra_Vector &y, Epetra_Vector &result) const;

    int
    Apply(const Epetra_MultiVector &x, Epetra_MultiVector &result) const override;

  private:
    /** A factor of the product, as T: the identity but for few lines. */
    class Factor
    {
    public:
      /** @param constraints  Lines of the factor, together with the change of basis.
       *  @param shift        Takes their inhomogeneities, unless null. */
      Factor(const AppliedOperator                   &owner,
             const dealii::AffineConstraints<double> &constraints,
             const dealii::AffineConstraints<double> &basis_change,
             const Epetra_Vector                     *scale,
             Epetra_Vector                           *shift);

      /** @brief result = T x. Collective. */
      void
      apply(const Epetra_Vector &x, Epetra_Vector &result) const;

      /** @brief result = T^T x; changes @p x. Collective. */
      void
      apply_transposed(Epetra_Vector &x, Epetra_Vector &result) const;

    private:
      std::vector<int>                  unknowns;
      std::unique_ptr<Epetra_CrsMatrix> lines;
      std::unique_ptr<Epetra_Vector>    of_lines;
    };

    const LinearSystem     &system;
    std::unique_ptr<Factor> motion, test;
    /** The contact terms C = L^T R, a row for each of this rank; null without any. */
    std::unique_ptr<Epetra_CrsMatrix> left, right;
    std::unique_ptr<Epetra_Vector>    stretch;
    /** The g of x = T y + g. */
    Epetra_Vector inhomogeneity;
    /** Diagonal entries of constrained unknowns, zero at others. */
    Epetra_Vector         diagonal;
    mutable Epetra_Vector all, force, part;

    /** @brief Forms of this rank's terms as the rows of a matrix. */
    std::unique_ptr<Epetra_CrsMatrix>
    forms(LinearForm RankOneTerm::*side) const;

    /** @brief A matrix of any number of rows on each rank, for vectors of unknowns. */
    std::unique_ptr<Epetra_CrsMatrix>
    make_matrix(const std::vector<SparseRow> &rows, const LocalNumbers &numbers) const;

    /** @brief result = (A + D + C) x, of all unknowns. */
    void
    multiply(const Epetra_Vector &x, Epetra_Vector &result) const;
  };
} // namespace Touchstone

#endif
