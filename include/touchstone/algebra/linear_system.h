// SPDX-License-Identifier: LGPL-2.1-or-later

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
  /** @brief Coefficients of dofs, by global indices, which may be those of any rank;
   * coefficients of equal number add up. */
  using LinearForm = std::vector<std::pair<Index, double>>;

  /** @brief Values of linear forms of the dofs @p x (owned). Collective. */
  std::vector<double>
  evaluate_forms(const std::vector<LinearForm> &forms, const Vector &x);

  /**
   * @brief A matrix of rank one, left right^T: a force along @p left that grows with
   * @p right of the displacement, as that of a spring does.
   *
   * The matrix entries of a spring between a node and a face are as many as the square of
   * its dofs; as a product it takes part in products with vectors, changes of
   * basis and condensation at the cost of its dofs.
   */
  struct RankOneTerm
  {
    LinearForm left, right;
  };

  /**
   * @brief The linear system of a Newton iteration as its parts: continuum
   * stiffness, contact terms, multipliers, constraints, right-hand side.
   *
   * The displacement dofs come first; multipliers of all
   * ranks follow, numbered by rank.
   */
  struct LinearSystem
  {
    /** Continuum stiffness without any condition; symmetric pattern. */
    const Matrix *stiffness = nullptr;
    /** Added to the diagonal of the displacement block, force per length; may
     * be empty. */
    Vector diagonal_shift;
    /** Contact terms, of displacement and multipliers. */
    std::vector<RankOneTerm> terms;
    /** Number of multipliers of this rank, and number of the first. */
    Index n_extra = 0, first_extra = 0;
    /** Conditions on the displacement increment; and on the test functions, where
     * they are not the same. */
    dealii::AffineConstraints<double>                constraints;
    std::optional<dealii::AffineConstraints<double>> test_constraints;
    /**
     * Change of basis: dofs x_i = y_i + sum_j c_j x_j are replaced by y_i, the elongation of a
     * stiff spring between x_i and the others, for solvers that such springs slow down. The
     * others are neither constrained nor replaced themselves, and there are no inhomogeneities.
     */
    dealii::AffineConstraints<double> basis_change;
    /** The same for the test functions, of the same dofs, where it is not the same. */
    std::optional<dealii::AffineConstraints<double>> test_basis_change;
    /** Out-of-balance forces, and right-hand side of the multipliers. */
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
     * dofs; force. Collective.
     * @param displacement x, all of it.
     * @param extra        Multipliers of this rank. */
    Vector
    residual(const Vector &displacement, const std::vector<double> &extra) const;
  };
} // namespace Touchstone

#endif
