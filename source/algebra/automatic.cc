// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/convergence_watch.h>
#include <touchstone/algebra/linear_solver.h>
#include <touchstone/base/non_convergence.h>

#include <algorithm>

// The default linear solver, which chooses among the registered ones for each system: a
// factorisation for small systems and those with multipliers, Krylov methods with multigrid for
// large ones, and MUMPS again where these fail. So an input file needs no knowledge of solvers;
// what was chosen against expectation goes to the log (doc/theory.md, section 8).
namespace Touchstone
{
  namespace
  {
    /** From this number of dofs on, iterations with multigrid are faster than
     * a factorisation (doc/benchmarks.md), unless they are many. */
    constexpr int many_dofs = 10000;

    /**
     * Iterations with multigrid where the system is large and has no multipliers, conjugate
     * gradients if it is symmetric and GMRES otherwise; else MUMPS: also
     * for the rest of the run where iterations have failed for good.
     */
    class AutomaticSolver : public LinearSolver
    {
    public:
      explicit AutomaticSolver(const LinearSolverParameters &parameters)
        : LinearSolver(parameters)
        , direct(LinearSolverRegistry::make("MUMPS", parameters))
      {
      }

      // Whether iterations fail is not known when the input is read, so the keys of both methods
      // are accepted.
      std::set<std::string>
      used_options() const override
      {
        return {parameters.type, "MUMPS", parameters.preconditioner};
      }

      bool
      wants_basis_change(const int n_dofs) const override
      {
        return iterates(n_dofs);
      }

      bool
      applies_operator(const int n_dofs) const override
      {
        return iterates(n_dofs) &&
               parameters.contact_operator == LinearSolverParameters::ContactOperator::applied;
      }

      bool
      factorises(const int n_dofs) const override
      {
        return n_dofs < many_dofs || parameters.prefers_factors(n_dofs);
      }

      void
      clear_cache() override
      {
        strikes.succeeded();
        for (Method *method : {&cg, &gmres})
          if (method->solver)
            method->solver->clear_cache();
        direct->clear_cache();
      }

    private:
      // Made when first needed: a symmetric scene never makes GMRES.
      struct Method
      {
        const std::string             name;
        std::shared_ptr<LinearSolver> solver;
      };
      Method                              cg{"Belos CG", nullptr}, gmres{"Belos GMRES", nullptr};
      const std::shared_ptr<LinearSolver> direct;
      Strikes                             strikes;
      bool                                told_of_one = false, told_of_all = false;

      bool
      iterates(const int n_dofs) const
      {
        return !strikes.out() && n_dofs >= many_dofs && !parameters.prefers_factors(n_dofs);
      }

      /**
       * An iterative solver that gives up as soon as its ConvergenceWatch foresees more
       * iterations than a factorisation of a system of this size is worth; the size does not
       * change during a run. A patience that is set also tells it to fail instead of factorising
       * by itself.
       */
      LinearSolver &
      make(Method &method, const int n_dofs) const
      {
        if (!method.solver)
          {
            LinearSolverParameters with_patience = parameters;
            with_patience.type                   = method.name;
            with_patience.patience = static_cast<unsigned int>(ConvergenceWatch::patience(n_dofs));
            with_patience.maximum_iterations =
              std::min(parameters.maximum_iterations, with_patience.patience);
            method.solver = LinearSolverRegistry::make(method.name, with_patience);
          }
        return *method.solver;
      }

      void
      do_solve(const CondensedSystem &system,
               const RigidMotions    &motions,
               Epetra_Vector         &solution) override
      {
        // Multipliers make the system indefinite: neither conjugate gradients nor the smoothers
        // of multigrid, which need positive eigenvalues, can take it.
        const int n_dofs = system.rows().NumGlobalElements();
        bool      solved = false;
        if (!system.definite && n_dofs >= many_dofs)
          remark("linear solver: MUMPS, for multigrid cannot solve a system with multipliers");
        else if (n_dofs >= many_dofs && parameters.prefers_factors(n_dofs))
          remark("linear solver: MUMPS, for " + parameters.incompressibility());
        else if (iterates(n_dofs))
          solved = try_to_iterate(system, motions, solution);
        if (!solved)
          delegate(*direct, system, motions, solution);
        // Counts of the solvers used are those of this one: delegate() bypasses their own
        // solve().
        count.factorisations = direct->counts().factorisations;
        count.iterations = count.preconditioner_setups = 0;
        for (const Method *method : {&cg, &gmres})
          if (method->solver)
            {
              count.iterations += method->solver->counts().iterations;
              count.preconditioner_setups += method->solver->counts().preconditioner_setups;
            }
      }

      /**
       * A remark in the log for the first solve that falls back to MUMPS, and another one when
       * iterations are given up for the rest of the run; repeated failures do not fill the log.
       */
      void
      tell(const std::string &reason)
      {
        if (strikes.out() && !told_of_all)
          remark("linear solver: MUMPS from now on (" + reason + ")");
        else if (!strikes.out() && !told_of_one)
          remark("linear solver: MUMPS where iterations fail (" + reason + ")");
        (strikes.out() ? told_of_all : told_of_one) = true;
      }

      /** @return Whether it succeeded. */
      bool
      try_to_iterate(const CondensedSystem &system,
                     const RigidMotions    &motions,
                     Epetra_Vector         &solution)
      {
        // A preconditioner of one method is of no use for the other, and both together may not
        // fit into memory.
        Method &method = system.symmetric ? cg : gmres, &other = system.symmetric ? gmres : cg;
        if (other.solver)
          other.solver->clear_cache();
        LinearSolver &iterative = make(method, system.rows().NumGlobalElements());
        try
          {
            delegate(iterative, system, motions, solution);
            for (const std::string &text : iterative.take_remarks())
              remark(text);
            strikes.succeeded();
            return true;
          }
        catch (const LinearSolverFailure &failure)
          {
            strikes.failed(system.symmetric);
            tell(failure.what());
            iterative.clear_cache();
            // What the failed iteration left may be far off or not finite; the direct solver
            // starts afresh.
            solution.PutScalar(0.);
            return false;
          }
      }
    };

    const LinearSolverRegistry::Entry<AutomaticSolver>
      automatic_entry("automatic",
                      "from 10,000 dofs on and without multipliers, Belos CG for symmetric systems "
                      "and Belos GMRES for others; MUMPS otherwise, or if these would take longer, "
                      "which the log says.");
  } // namespace
} // namespace Touchstone
