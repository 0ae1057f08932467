#include <touchstone/algebra/linear_solver.h>
#include <touchstone/algebra/non_convergence.h>

#include <algorithm>

namespace Touchstone
{
  namespace
  {
    /** From this number of unknowns on, conjugate gradients with multigrid are faster than
     * a factorisation (doc/benchmarks.md), unless they take more iterations than these. */
    constexpr int          many_unknowns = 10000;
    constexpr unsigned int patience      = 300;

    /**
     * Conjugate gradients where the system is large and allows it, else MUMPS: also
     * for the rest of the run where the iteration has once failed.
     */
    class AutomaticSolver : public LinearSolver
    {
    public:
      explicit AutomaticSolver(const LinearSolverParameters &parameters)
        : LinearSolver(parameters)
        , iterative(LinearSolverRegistry::make("Belos CG", with_patience(parameters)))
        , direct(LinearSolverRegistry::make("MUMPS", parameters))
      {
      }

      bool
      wants_basis_change(const int n_unknowns) const override
      {
        return !failed && n_unknowns >= many_unknowns;
      }

      bool
      applies_operator(const int n_unknowns) const override
      {
        return !failed && n_unknowns >= many_unknowns && iterative->applies_operator(n_unknowns);
      }

      void
      forget() override
      {
        failed = false;
        iterative->forget();
        direct->forget();
      }

    private:
      const std::shared_ptr<LinearSolver> iterative, direct;
      bool                                failed = false;

      static LinearSolverParameters
      with_patience(LinearSolverParameters parameters)
      {
        parameters.maximum_iterations = std::min(parameters.maximum_iterations, patience);
        return parameters;
      }

      void
      do_solve(const CondensedSystem &system,
               const RigidMotions    &motions,
               Epetra_Vector         &solution) override
      {
        const bool try_iterations = !failed && system.symmetric && system.definite &&
                                    system.rows().NumGlobalElements() >= many_unknowns;
        if (try_iterations)
          try
            {
              delegate(*iterative, system, motions, solution);
            }
          catch (const LinearSolverFailure &)
            {
              failed = true;
              iterative->forget();
            }
        if (!try_iterations || failed)
          delegate(*direct, system, motions, solution);
        count.iterations            = iterative->counts().iterations;
        count.preconditioner_setups = iterative->counts().preconditioner_setups;
        count.factorisations        = direct->counts().factorisations;
      }
    };

    const LinearSolverRegistry::Entry<AutomaticSolver>
      entry("automatic", "Belos CG for large symmetric positive definite systems, else MUMPS");
  } // namespace
} // namespace Touchstone
