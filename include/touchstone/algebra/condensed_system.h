// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_condensed_system_h
#define touchstone_algebra_condensed_system_h

#include <touchstone/algebra/condensed_operator.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Vector.h>
#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief A linear system with its constraints condensed out, S^T A T y = S^T (b - A g) for
   * x = T y + g and test functions S z (doc/theory.md, section 7), for all linear solvers.
   * S = T where the test functions have the same constraints.
   *
   * Constrained dofs keep a diagonal entry and a zero right-hand side.
   */
  class CondensedSystem
  {
  public:
    /**
     * @param system  Must live as long.
     * @param applied Products are made factor by factor (AppliedOperator);
     * otherwise with the assembled matrix (AssembledOperator). Collective.
     */
    explicit CondensedSystem(const LinearSystem &system, bool applied = false);

    CondensedSystem(const CondensedSystem &) = delete;
    CondensedSystem &
    operator=(const CondensedSystem &) = delete;

    /** @brief Dofs of this rank, multipliers last. */
    const Epetra_Map &
    rows() const
    {
      return dofs;
    }

    /** @brief Number of displacements, of all ranks. */
    int
    n_displacements() const
    {
      return static_cast<int>(system.rhs.size());
    }

    /** @brief What multiplies a solution. */
    Epetra_Operator &
    product() const
    {
      return condensed->product();
    }

    /** @brief The matrix; if products are applied it is assembled in each call:
     * keep it no longer than needed. Collective. */
    std::shared_ptr<Epetra_CrsMatrix>
    matrix() const
    {
      return condensed->matrix();
    }

    /** @brief The same to be read node by node; of displacements only.
     * Collective. */
    std::unique_ptr<BlockRows>
    block_rows() const
    {
      return condensed->block_rows();
    }

    /** @brief Entry of the diagonal of the stiffness itself, by local index. */
    double
    stiffness_diagonal(const unsigned int i) const
    {
      return system.stiffness->diagonal(i);
    }

    /** @brief The displacement part of x = T y + g for a solution y. Collective.
     */
    void
    expand(const Epetra_Vector &solution, Vector &displacement) const;

    /**
     * @brief Correct the elongations of springs (LinearSystem::basis_change) by their own
     * equations, in one step of Jacobi's method.
     *
     * The residual by which iterations stop has these equations in the units s of the elongations,
     * so that the forces of stiff springs are left out of balance by 1/s times as much; and a node
     * whose force comes out as a pull leaves the contact. The other equations notice s times as
     * little of the correction.
     *
     * @param rest Residual of @p solution.
     */
    void
    correct_elongations(const Epetra_Vector &rest, Epetra_Vector &solution) const;

    std::unique_ptr<Epetra_Vector> rhs;
    /** Marks rows of constrained dofs, in the order of the local rows. */
    std::vector<bool> constrained;
    /** Marks rows of dofs that are the elongation of a spring
     * (LinearSystem::basis_change). */
    std::vector<bool> changed;
    const bool        symmetric, definite;
    const double      tolerance;

  private:
    const LinearSystem &system;
    const Epetra_Map    dofs;
    /** Scales s of dofs and equations, x = s y, other than one for the elongations of springs
     * (doc/theory.md, section 7, equation (23)), so that an error of these counts as much in the
     * residual as one of a displacement. Null: all are one. */
    std::unique_ptr<Epetra_Vector> units;
    /** T and g; and S, null if it is T. */
    std::unique_ptr<Transformation>    trial, test;
    std::unique_ptr<CondensedOperator> condensed;

    void
    make_units();
  };
} // namespace Touchstone

#endif
