#include <touchstone/algebra/linear_solver.h>
#include <touchstone/algebra/non_convergence.h>

#include <cmath>
#include <string>

namespace Touchstone
{
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
    if (!std::isfinite(rhs_norm))
      throw LinearSolverFailure("the right-hand side of the linear system is not finite");
    do_solve(system, motions, solution);

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
    if (system.scale)
      solution.Multiply(1., *system.scale, solution, 0.);
  }
} // namespace Touchstone
