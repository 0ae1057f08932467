#ifndef touchstone_algebra_linear_system_h
#define touchstone_algebra_linear_system_h

#include <touchstone/algebra/vector.h>
#include <touchstone/types.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/affine_constraints.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Vector.h>
#include <memory>
#include <optional>
#include <vector>

namespace Touchstone
{
  /** @brief One matrix entry given by global numbers; may lie in a row of any
   * rank, and entries at the same place add up. */
  struct MatrixTerm
  {
    Index  row, column;
    double value;
  };

  /**
   * @brief The linear system of a Newton iteration as its parts: continuum
   * stiffness, contact terms, extra unknowns, constraints, right-hand side.
   *
   * The displacement unknowns come first; extra unknowns (multipliers) of all
   * ranks follow, numbered by rank.
   */
  struct LinearSystem
  {
    /** Continuum stiffness without any condition; symmetric pattern. */
    const Matrix *stiffness = nullptr;
    /** Added to the diagonal of the displacement block, force per length; may
     * be empty. */
    Vector diagonal_shift;
    /** Contact terms, of displacement and extra unknowns. */
    std::vector<MatrixTerm> terms;
    /** Number of extra unknowns of this rank, and number of the first. */
    Index n_extra = 0, first_extra = 0;
    /** Conditions on the displacement increment; and on the test functions, where
     * they are not the same. */
    dealii::AffineConstraints<double>                constraints;
    std::optional<dealii::AffineConstraints<double>> test_constraints;
    /** Out-of-balance forces, and right-hand side of the extra unknowns. */
    Vector              rhs;
    std::vector<double> extra_rhs;
    /** The solver takes symmetric systems only: unsymmetric parts are lagged. */
    bool keep_symmetric = false;
    bool symmetric      = true;
    /** Positive definite: no multipliers. */
    bool definite = true;
    /** Relative residual that an iterative solution needs. */
    double tolerance = 1e-8;
  };

  /**
   * @brief A linear system with its constraints condensed out, S^T A T y = S^T
   * (b - A g) for x = T y + g and test functions S z, as plain distributed rows
   * that all back ends understand. S = T where the test functions have the same
   * constraints.
   *
   * Rows that no constraint and no contact term touches are copied, so the cost
   * beyond the copy is that of the constrained neighbourhood. Constrained
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
    bool              symmetric, definite;
    double            tolerance;
  };
} // namespace Touchstone

#endif
