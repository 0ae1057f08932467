// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/linear_solver.h>
#include <touchstone/base/non_convergence.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <string>
#include <utility>

// What all linear solvers share: the check of the input, the translation of whatever a library
// throws into failures that cut the time step, and the check of the true residual of the result
// (doc/theory.md, section 8).
namespace Touchstone
{
  namespace
  {
    /**
     * A product with a vector of ones shows all entries that are not finite: Inf and NaN spread
     * to whatever they are added to, even where they are multiplied by zero. The matrix is judged
     * before the right-hand side, since condensation carries its entries over to the right-hand
     * side and the message should name the cause. The norm is a sum over all ranks, so all throw
     * or none.
     */
    void
    check_finite(const CondensedSystem &system, const double rhs_norm)
    {
      Epetra_Vector one(system.rhs->Map()), product(system.rhs->Map());
      double        norm = 0.;
      one.PutScalar(1.);
      system.product().Apply(one, product);
      product.Norm2(&norm);
      if (!std::isfinite(norm))
        throw LinearSolverFailure(
          "the matrix of the linear system has entries that are not finite");
      if (!std::isfinite(rhs_norm))
        throw LinearSolverFailure("the right-hand side of the linear system is not finite");
    }
  } // namespace



  void
  LinearSolver::remark(const std::string &text)
  {
    if (known_remarks.insert(text).second)
      remarks.push_back(text);
  }



  std::vector<std::string>
  LinearSolver::take_remarks()
  {
    return std::exchange(remarks, {});
  }



  // A NonConvergence passes unchanged, for it is in the terms of this program already. Anything
  // kept for later solves may be inconsistent after an exception and is dropped.
  void
  LinearSolver::guarded_solve(const CondensedSystem &system,
                              const RigidMotions    &motions,
                              Epetra_Vector         &solution)
  {
    std::string reason;
    try
      {
        return do_solve(system, motions, solution);
      }
    catch (const NonConvergence &)
      {
        clear_cache();
        throw;
      }
    catch (const std::bad_alloc &)
      {
        reason = "not enough memory";
      }
    catch (const std::exception &error)
      {
        // Libraries add places and traces to what they say; the first line is enough.
        reason = error.what();
        reason = reason.substr(0, reason.find('\n'));
      }
    // Epetra throws plain integers.
    catch (const int error)
      {
        reason = "Epetra reports error " + std::to_string(error);
      }
    clear_cache();
    throw LinearSolverFailure("the linear solver " + parameters.type + " failed: " + reason);
  }



  void
  LinearSolver::solve(const CondensedSystem &system,
                      const RigidMotions    &motions,
                      Epetra_Vector         &solution)
  {
    ++count.solves;
    double rhs_norm = 0.;
    system.rhs->Norm2(&rhs_norm);
    solution.PutScalar(0.);
    // The solution is zero; a relative residual would not be defined.
    if (rhs_norm == 0.)
      return;
    check_finite(system, rhs_norm);
    guarded_solve(system, motions, solution);

    Epetra_Vector rest(system.rhs->Map());
    system.product().Apply(solution, rest);
    rest.Update(1., *system.rhs, -1.);
    double residual = 0.;
    rest.Norm2(&residual);
    residual /= rhs_norm;
    // Neither kind of solver is trusted: a direct one meets null pivots and round-off without
    // notice, an iterative one stops by a residual that is updated and not computed anew, and can
    // drift from the true one. The factor and the lower bound leave room for exactly that
    // round-off.
    if (!(residual <= std::max(10. * system.tolerance, 1e-6)))
      throw LinearSolverFailure("the linear solver " + parameters.type +
                                " left a true relative residual of " + std::to_string(residual));
    system.correct_elongations(rest, solution);
  }
} // namespace Touchstone
