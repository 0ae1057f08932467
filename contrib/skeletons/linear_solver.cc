// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/linear_solver.h>
#include <touchstone/base/non_convergence.h>

#include <Amesos_Klu.h>
#include <Epetra_LinearProblem.h>

namespace Touchstone
{
  namespace
  {
    /** Trilinos' own serial direct solver. */
    class Klu : public LinearSolver
    {
    public:
      explicit Klu(const LinearSolverParameters &parameters)
        : LinearSolver(parameters)
      {
      }

    private:
      void
      do_solve(const CondensedSystem &system,
               const RigidMotions &,
               Epetra_Vector &solution) override
      {
        const auto           matrix = system.matrix();
        Epetra_LinearProblem problem(matrix.get(), &solution, system.rhs.get());
        Amesos_Klu           klu(problem);
        if (klu.NumericFactorization() != 0 || klu.Solve() != 0)
          throw LinearSolverFailure("KLU: the factorisation failed");
        ++count.factorisations;
      }
    };

    const LinearSolverRegistry::Entry<Klu> klu("KLU", "serial direct solver of Trilinos");
  } // namespace
} // namespace Touchstone
