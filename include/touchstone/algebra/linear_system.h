#ifndef touchstone_algebra_linear_system_h
#define touchstone_algebra_linear_system_h

#include <touchstone/algebra/matrix.h>
#include <touchstone/base/types.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/affine_constraints.h>

#include <optional>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief Coefficients of unknowns, by global numbers, which may be those of any rank;
   * coefficients of equal number add up. */
  using LinearForm = std::vector<std::pair<Index, double>>;

  /** @brief Values of linear forms of the unknowns @p x (owned). Collective. */
  std::vector<double>
  evaluate_forms(const std::vector<LinearForm> &forms, const Vector &x);

  /**
   * @brief A matrix of rank one, left right^T: a force along @p left that grows with
   * @p right of the displacement, as that of a spring does.
   *
   * The matrix entries of a spring between a node and a face are as many as the square of
   * its unknowns; as a product it takes part in products with vectors, changes of
   * basis and condensation at the cost of its unknowns.
   */
  struct RankOneTerm
  {
    LinearForm left, right;
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
    std::vector<RankOneTerm> terms;
    /** Number of extra unknowns of this rank, and number of the first. */
    Index n_extra = 0, first_extra = 0;
    /** Conditions on the displacement increment; and on the test functions, where
     * they are not the same. */
    dealii::AffineConstraints<double>                constraints;
    std::optional<dealii::AffineConstraints<double>> test_constraints;
    /**
     * Unknowns x_i = y_i + sum_j c_j x_j that are to be replaced by their
     * deviation y_i from others, for solvers that suffer from stiff springs between
     * x_i and the others. These are neither constrained nor replaced themselves, and
     * there are no inhomogeneities.
     */
    dealii::AffineConstraints<double> basis_change;
    /** The same for the test functions, of the same unknowns, where it is not the same. */
    std::optional<dealii::AffineConstraints<double>> test_basis_change;
    /** Out-of-balance forces, and right-hand side of the extra unknowns. */
    Vector              rhs;
    std::vector<double> extra_rhs;
    /** The solver takes symmetric systems only: unsymmetric parts are lagged. */
    bool keep_symmetric = false;
    bool symmetric      = true;
    /** The solver takes multipliers, too. */
    bool takes_multipliers = false;
    /** Positive definite: no multipliers. */
    bool definite = true;
    /** Relative residual that an iterative solution needs. */
    double tolerance = 1e-8;

    /** @brief b - A x without the conditions and their forces, of this rank's displacement
     * unknowns; force. Collective.
     * @param displacement x, all of it.
     * @param extra        Extra unknowns of this rank. */
    Vector
    residual(const Vector &displacement, const std::vector<double> &extra) const;
  };
} // namespace Touchstone

#endif
