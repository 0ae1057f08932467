#ifndef touchstone_algebra_condensed_system_h
#define touchstone_algebra_condensed_system_h

#include <touchstone/algebra/linear_system.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Vector.h>
#include <memory>
#include <vector>

namespace Touchstone
{
  class AppliedOperator;

  /**
   * @brief A linear system with its constraints condensed out, S^T A T y = S^T
   * (b - A g) for x = T y + g and test functions S z, as plain distributed rows
   * that all back ends understand. S = T where the test functions have the same
   * constraints.
   *
   * Rows that no constraint and no contact term touches are those of the
   * stiffness. Constrained unknowns keep a diagonal entry and a zero right-hand side.
   */
  class CondensedSystem
  {
  public:
    /**
     * @param system  Must live as long.
     * @param applied Products are made factor by factor (AppliedOperator), and matrix() is
     *                assembled for those who ask for it. Otherwise both are the same
     *                matrix.
     */
    explicit CondensedSystem(const LinearSystem &system, bool applied = false);

    /** @brief Unknowns of this rank, extra ones last. */
    const Epetra_Map &
    rows() const
    {
      return row_map;
    }

    /** @brief What multiplies a solution. */
    Epetra_Operator &
    product() const;

    /** @brief The matrix, assembled anew in each call if products are applied: keep it no
     * longer than needed. Collective. */
    std::shared_ptr<Epetra_CrsMatrix>
    matrix() const;

    /** @brief The same to be read node by node, without the making of a matrix where products
     * are applied; of displacements only. Collective. */
    std::unique_ptr<BlockRows>
    block_rows() const;

    /** @brief Entry of the diagonal of the stiffness itself, by local number. */
    double
    stiffness_diagonal(const unsigned int i) const
    {
      return system.stiffness->diagonal(i);
    }

    /** @brief The displacement part of x = T y + g. Collective.
     * @param solution y, of unknowns that are not divided by scale. */
    void
    expand(const Epetra_Vector &solution, Vector &displacement) const;

    std::unique_ptr<Epetra_Vector> rhs;
    /** Marks rows of constrained unknowns, in the order of the local rows. */
    std::vector<char> constrained;
    /** Marks rows of unknowns that count the deviation from a combination of
     * others. */
    std::vector<char> changed;
    /** The matrix is for unknowns divided by this; null: by one. Stiff
     * springs have their stretch in units that make an error of it count as much
     * as one of a displacement. */
    std::unique_ptr<Epetra_Vector> scale;
    const bool                     symmetric, definite;
    const double                   tolerance;

  private:
    const LinearSystem               &system;
    const Epetra_Map                  row_map;
    std::shared_ptr<Epetra_CrsMatrix> assembled;
    std::shared_ptr<AppliedOperator>  factors; // unless assembled

    void
    make_scale();

    /** @param values Right-hand side, not scaled, if not null. */
    std::shared_ptr<Epetra_CrsMatrix>
    assemble(std::vector<double> *values) const;
  };
} // namespace Touchstone

#endif
