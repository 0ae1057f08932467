// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_linear_solver_h
#define touchstone_algebra_linear_solver_h

#include <touchstone/algebra/condensed_system.h>
#include <touchstone/algebra/preconditioner.h>
#include <touchstone/algebra/solver_parameters.h>
#include <touchstone/base/registry.h>

#include <set>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief What linear solvers have done so far; the same on all ranks. */
  struct LinearSolverCounts
  {
    unsigned int solves                = 0;
    unsigned int iterations            = 0;
    unsigned int factorisations        = 0;
    unsigned int preconditioner_setups = 0;
  };

  /**
   * @brief Solves condensed systems; registered under the name that the scene
   * file uses.
   */
  class LinearSolver
  {
  public:
    explicit LinearSolver(const LinearSolverParameters &parameters)
      : parameters(parameters)
    {
    }

    virtual ~LinearSolver() = default;

    /**
     * @brief Solve and check the true residual.
     * @param system   The condensed system.
     * @param motions  Of the bodies.
     * @param solution Result, over the rows of the matrix, for CondensedSystem::expand().
     * @throws LinearSolverFailure if the residual stays above the tolerance, the system is not
     *         finite, or a library fails in any way;
     *         SingularSystem if the matrix turns out singular; on all ranks.
     */
    void
    solve(const CondensedSystem &system, const RigidMotions &motions, Epetra_Vector &solution);

    /** @brief Registered names of the solvers and preconditioners whose keys it uses, itself
     * included. An input file that sets keys of others is rejected. */
    virtual std::set<std::string>
    used_options() const
    {
      return {parameters.type, parameters.preconditioner};
    }

    /** @brief Whether it takes systems with multipliers, which are indefinite. */
    virtual bool
    takes_multipliers() const
    {
      return true;
    }

    /** @brief Whether it uses the key `Preconditioner`. */
    virtual bool
    takes_preconditioner() const
    {
      return false;
    }

    /** @brief Whether it takes symmetric positive definite systems only. */
    virtual bool
    symmetric_only() const
    {
      return false;
    }

    /** @brief Whether stiff springs slow it down unless their elongation is a dof
     * (LinearSystem::basis_change), in a system of that size. */
    virtual bool
    wants_basis_change(int /*n_dofs*/) const
    {
      return false;
    }

    /** @brief Whether it multiplies by a system of that size matrix-free (AppliedOperator). */
    virtual bool
    applies_operator(int /*n_dofs*/) const
    {
      return false;
    }

    /** @brief Whether a system of that size is factorised, so that it need not be definite. */
    virtual bool
    factorises(int /*n_dofs*/) const
    {
      return false;
    }

    /** @brief Drop factors and preconditioners that are kept from one solve for the next. Done
     * where a checkpoint is written: a run that resumes from it has none, and must give the same
     * results as the run that continues. Collective. */
    virtual void
    clear_cache()
    {
    }

    const LinearSolverCounts &
    counts() const
    {
      return count;
    }

    /** @brief What the user should know of its choices, each remark once: lines that have not
     * been asked for yet. The same on all ranks. */
    std::vector<std::string>
    take_remarks();

  protected:
    const LinearSolverParameters parameters;
    LinearSolverCounts           count;

    /** @brief Add @p text to the remarks unless it has been one before. */
    void
    remark(const std::string &text);

    /** @brief Let @p other solve, without the checks of solve(), which this solver makes itself.
     * @throws as solve() */
    static void
    delegate(LinearSolver          &other,
             const CondensedSystem &system,
             const RigidMotions    &motions,
             Epetra_Vector         &solution)
    {
      other.guarded_solve(system, motions, solution);
    }

    virtual void
    do_solve(const CondensedSystem &system,
             const RigidMotions    &motions,
             Epetra_Vector         &solution) = 0;

  private:
    std::vector<std::string> remarks;
    std::set<std::string>    known_remarks;

    /** @brief do_solve(), with what libraries throw turned into a LinearSolverFailure. */
    void
    guarded_solve(const CondensedSystem &system,
                  const RigidMotions    &motions,
                  Epetra_Vector         &solution);
  };

  using LinearSolverRegistry = Registry<LinearSolver, const LinearSolverParameters &>;
} // namespace Touchstone

#endif
