// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/linear_solver.h>
#include <touchstone/base/non_convergence.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <string>
#include <utility>

namespace Touchstone
{
  namespace
  {
    /** One product shows all entries that are not finite, for these make what they
     * meet not finite whatever it is. First, as they get into the right-hand side by
     * condensation. */
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
    // So does Epetra report errors.
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
    // A direct solver cannot do better than round-off allows, an iterative one
    // goes by a residual that it updates: neither is believed.
    if (!(residual <= std::max(10. * system.tolerance, 1e-6)))
      throw LinearSolverFailure("the linear solver " + parameters.type +
                                " left a true relative residual of " + std::to_string(residual));
  }
} // namespace Touchstone
