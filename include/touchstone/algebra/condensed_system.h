#ifndef touchstone_algebra_condensed_system_h
#define touchstone_algebra_condensed_system_h

#include <touchstone/algebra/linear_system.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Vector.h>
#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief A linear system with its constraints condensed out, S^T A T y = S^T
   * (b - A g) for x = T y + g and test functions S z, as plain distributed rows
   * that all back ends understand. S = T where the test functions have the same
   * constraints.
   *
   * Rows that no constraint and no contact term touches are those of the
   * stiffness: copied, or only referred to if the stiffness lasts. Constrained
   * unknowns keep a diagonal entry and a zero right-hand side.
   */
  class CondensedSystem
  {
  public:
    explicit CondensedSystem(const LinearSystem &system);

    /** Shared with preconditioners that are made from it. */
    std::shared_ptr<Epetra_CrsMatrix> matrix;
    std::unique_ptr<Epetra_Vector>    rhs;
    /** Marks rows of constrained unknowns, in the order of the local rows. */
    std::vector<char> constrained;
    /** Marks rows of unknowns that count the deviation from a combination of
     * others. */
    std::vector<char> changed;
    /** The matrix is for unknowns divided by this; null: by one. Stiff
     * springs have their stretch in units that make an error of it count as much
     * as one of a displacement. */
    std::unique_ptr<Epetra_Vector> scale;
    bool                           symmetric, definite;
    double                         tolerance;

  private:
    void
    scale_changed(const Epetra_CrsMatrix &stiffness);
  };
} // namespace Touchstone

#endif
