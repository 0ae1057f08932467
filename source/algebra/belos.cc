// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/convergence_watch.h>
#include <touchstone/algebra/kept_factors.h>
#include <touchstone/algebra/linear_solver.h>
#include <touchstone/algebra/watched_iteration.h>
#include <touchstone/base/free_memory.h>
#include <touchstone/base/non_convergence.h>

#include <BelosBlockCGSolMgr.hpp>
#include <BelosBlockGmresSolMgr.hpp>
#include <BelosEpetraAdapter.hpp>
#include <BelosLinearProblem.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Teuchos_RCP.hpp>
#include <Teuchos_oblackholestream.hpp>
#include <memory>
#include <utility>

// The Krylov methods of Trilinos (Belos): conjugate gradients and GMRES, with a preconditioner
// that is kept over several solves. What takes the most care is to notice that multigrid
// converges badly: then factors of MUMPS become the preconditioner, as long as the system is
// small enough for them (doc/theory.md, section 8).
namespace Touchstone
{
  namespace
  {
    using Problem = Belos::LinearProblem<double, Epetra_MultiVector, Epetra_Operator>;
    using Manager = Belos::SolverManager<double, Epetra_MultiVector, Epetra_Operator>;

    /**
     * Restarted GMRES, preconditioned from the right, so that the residual that
     * it minimises is the true one, and flexible: multigrid in single precision is a linear
     * operator only up to its round-off, below which the residual could not fall otherwise.
     * Saad (1993), SIAM J. Sci. Comput. 14.
     */
    std::unique_ptr<Manager>
    flexible_gmres(const LinearSolverParameters               &parameters,
                   const Teuchos::RCP<Problem>                &problem,
                   const Teuchos::RCP<Teuchos::ParameterList> &list,
                   const Epetra_Operator                      &preconditioner,
                   ConvergenceWatch                           &watch)
    {
      problem->setRightPrec(Teuchos::rcp(new Belos::EpetraPrecOp(
        Teuchos::rcpFromRef(const_cast<Epetra_Operator &>(preconditioner)))));
      problem->setProblem();
      // Belos limits the restarts, too: as many as the maximum of iterations allows.
      const int basis = std::min(parameters.restart, parameters.maximum_iterations);
      list->set("Num Blocks", basis);
      list->set("Maximum Restarts", static_cast<int>(parameters.maximum_iterations) / basis);
      list->set("Flexible Gmres", true);
      auto result =
        std::make_unique<Belos::BlockGmresSolMgr<double, Epetra_MultiVector, Epetra_Operator>>(
          problem, list);
      // A debug status test is called in each iteration, whatever the output is.
      result->setDebugStatusTest(Teuchos::rcp(new WatchingTest(watch)));
      return result;
    }



    /** A Krylov method from Belos with a preconditioner of the registry. */
    class BelosSolver : public LinearSolver
    {
    public:
      explicit BelosSolver(const LinearSolverParameters &parameters)
        : LinearSolver(parameters)
        , preconditioner_maker(PreconditionerRegistry::make(parameters.preconditioner))
      {
      }

      bool
      takes_multipliers() const override
      {
        return false;
      }

      bool
      takes_preconditioner() const override
      {
        return true;
      }

      // A stiff spring is a large term of rank one, which no smoother of single nodes resolves; as
      // an elongation dof it is one diagonal entry (doc/theory.md, section 7, equation (23)).
      bool
      wants_basis_change(int) const override
      {
        return true;
      }

      bool
      applies_operator(int) const override
      {
        return parameters.contact_operator == LinearSolverParameters::ContactOperator::applied;
      }

      void
      clear_cache() override
      {
        preconditioner.reset();
        strikes.succeeded();
        slow = indefinite = false;
      }

    private:
      const std::shared_ptr<const Preconditioner> preconditioner_maker;
      std::unique_ptr<Epetra_Operator>            preconditioner;
      /**
       * slow: factors are the preconditioner, for multigrid would take too many iterations; told:
       * the log says so. indefinite: conjugate gradients have broken down with the present
       * preconditioner, and GMRES takes it.
       */
      bool    slow = false, told = false, indefinite = false;
      Strikes strikes;
      /** Constrained dofs of its matrix, and those of changed basis. */
      std::vector<bool> constrained, changed;
      /** Iterations of the first solve with the present preconditioner. */
      int fresh_iterations = 0;

      void
      set_up(const CondensedSystem &system, const RigidMotions &motions);

      /** Make the preconditioner that the scene asks for. @throws SlowConvergence where it should
       * be replaced by factors. */
      std::unique_ptr<Epetra_Operator>
      make_preconditioner(const CondensedSystem &system, const RigidMotions &motions) const;

      /** Whether the preconditioner still serves. Collective. */
      bool
      fits(const CondensedSystem &system) const;

      /** Iterations above which multigrid is too slow for the system. */
      double
      patience(const CondensedSystem &system) const;

      /** Whether the system is small enough for factors. */
      bool
      factorisable(const CondensedSystem &system) const
      {
        return static_cast<unsigned int>(system.rows().NumGlobalElements()) <=
               parameters.factorise_up_to;
      }

      /** Take factors from the start where the materials are known to make multigrid slow. */
      void
      choose(const CondensedSystem &system);

      /** One run of the method, from zero. @param solution Zero. @return iterations, -1 if it
       * failed.
       * @throws SlowConvergence if it would take more iterations than patience(). */
      int
      iterate(const CondensedSystem &system, Epetra_Vector &solution);

      /** Iterate, with the preconditioner that there is or a new one. @return iterations, -1 if
       * it failed. */
      int
      iterate_or_renew(const CondensedSystem &system,
                       const RigidMotions    &motions,
                       Epetra_Vector         &solution);

      void
      do_solve(const CondensedSystem &system,
               const RigidMotions    &motions,
               Epetra_Vector         &solution) override;

      /** Make the method for @p problem, with @p preconditioner where it
       * belongs and @p watch where it sees the residual. */
      virtual std::unique_ptr<Manager>
      method(const Teuchos::RCP<Problem>                &problem,
             const Teuchos::RCP<Teuchos::ParameterList> &list,
             const Epetra_Operator                      &preconditioner,
             ConvergenceWatch                           &watch) const = 0;
    };



    /** Conjugate gradients. */
    class BelosCg : public BelosSolver
    {
    public:
      using BelosSolver::BelosSolver;

      bool
      symmetric_only() const override
      {
        return true;
      }

    private:
      std::unique_ptr<Manager>
      method(const Teuchos::RCP<Problem>                &problem,
             const Teuchos::RCP<Teuchos::ParameterList> &list,
             const Epetra_Operator                      &preconditioner,
             ConvergenceWatch                           &watch) const override
      {
        // First setProblem(), or it would apply the preconditioner to the first residual for
        // nothing. The watch sees the residual in the preconditioner, which conjugate gradients
        // apply to it once in each iteration.
        problem->setProblem();
        const auto watched = Teuchos::rcp(new WatchedPreconditioner(preconditioner, watch));
        problem->setLeftPrec(Teuchos::rcp(new Belos::EpetraPrecOp(watched)));
        return std::make_unique<Belos::BlockCGSolMgr<double, Epetra_MultiVector, Epetra_Operator>>(
          problem, list);
      }
    };

    /** Flexible GMRES. */
    class BelosGmres : public BelosSolver
    {
    public:
      using BelosSolver::BelosSolver;

    private:
      std::unique_ptr<Manager>
      method(const Teuchos::RCP<Problem>                &problem,
             const Teuchos::RCP<Teuchos::ParameterList> &list,
             const Epetra_Operator                      &preconditioner,
             ConvergenceWatch                           &watch) const override
      {
        return flexible_gmres(parameters, problem, list, preconditioner, watch);
      }
    };

    const LinearSolverRegistry::Entry<BelosCg>
      cg("Belos CG",
         "conjugate gradients with a preconditioner, for large models without multipliers; takes "
         "symmetric systems only, so that some derivatives of contact are left out.");

    const LinearSolverRegistry::Entry<BelosGmres>
      gmres("Belos GMRES",
            "restarted GMRES with a preconditioner, for large models without multipliers.");



    // If multigrid cannot be set up, e.g. as a level is indefinite, factors may still do: so this
    // counts as slow convergence. A simple preconditioner that fails is an error.
    std::unique_ptr<Epetra_Operator>
    BelosSolver::make_preconditioner(const CondensedSystem &system,
                                     const RigidMotions    &motions) const
    {
      try
        {
          return preconditioner_maker->set_up(system, motions);
        }
      catch (const LinearSolverFailure &failure)
        {
          if (!preconditioner_maker->multilevel())
            throw;
          throw SlowConvergence(failure.what());
        }
    }



    void
    BelosSolver::set_up(const CondensedSystem &system, const RigidMotions &motions)
    {
      // First free the old one: two hierarchies, or two sets of factors, may not fit into the
      // memory.
      preconditioner.reset();
      indefinite  = false;
      constrained = system.constrained;
      changed     = system.changed;
      if (slow)
        {
          preconditioner = std::make_unique<KeptFactors>(system);
          ++count.factorisations;
        }
      else
        preconditioner = make_preconditioner(system, motions);
      ++count.preconditioner_setups;
      fresh_iterations = 0;
    }



    // The automatic solver asks for iterations in larger systems only.
    void
    BelosSolver::choose(const CondensedSystem &system)
    {
      if (!preconditioner_maker->multilevel() || !parameters.nearly_incompressible())
        return;
      if (parameters.prefers_factors(system.rows().NumGlobalElements()))
        {
          remark(parameters.type + ": " + parameters.incompressibility() +
                 "; factors of MUMPS take its place");
          slow = true;
          strikes.failed(true);
        }
      else
        remark(parameters.type + ": " + parameters.incompressibility() +
               "; the system is too large for factors in its place ('Factorise up to')");
    }



    double
    BelosSolver::patience(const CondensedSystem &system) const
    {
      if (!preconditioner_maker->multilevel() || slow)
        return ConvergenceWatch::endless;
      if (parameters.patience > 0)
        return parameters.patience;
      return factorisable(system) ? ConvergenceWatch::patience(system.rows().NumGlobalElements())
                                  : ConvergenceWatch::endless;
    }



    bool
    BelosSolver::fits(const CondensedSystem &system) const
    {
      // It serves until the active set changes (other dofs are
      // condensed then: multigrid of an earlier set cost up to six times the
      // iterations, and factors near incompressibility up to a thousand times), or until it
      // costs half as many iterations again; a set-up of multigrid costs about ten.
      int same = preconditioner && constrained == system.constrained && changed == system.changed;
      int all_same = 0;
      system.rows().Comm().MinAll(&same, &all_same, 1);
      return all_same == 1;
    }



    int
    BelosSolver::iterate(const CondensedSystem &system, Epetra_Vector &solution)
    {
      // The vectors of the method come on top of all else: without the pieces that search and
      // assembly have left.
      give_back_free_memory();
      const auto problem =
        Teuchos::rcp(new Problem(Teuchos::rcpFromRef<Epetra_Operator>(system.product()),
                                 Teuchos::rcpFromRef<Epetra_MultiVector>(solution),
                                 Teuchos::rcpFromRef<Epetra_MultiVector>(*system.rhs)));
      // From zero the first residual is the right-hand side: no product and no vector for it.
      problem->setInitResVec(Teuchos::rcpFromRef<const Epetra_MultiVector>(*system.rhs));
      const auto list = Teuchos::rcp(new Teuchos::ParameterList());
      list->set("Maximum Iterations", static_cast<int>(parameters.maximum_iterations));
      list->set("Convergence Tolerance", system.tolerance);
      list->set("Verbosity", static_cast<int>(Belos::Errors));
      // It prints exceptions before it throws them.
      list->set("Output Stream", Teuchos::RCP<std::ostream>(new Teuchos::oblackholestream()));
      ConvergenceWatch               watch(system.tolerance, patience(system));
      const std::unique_ptr<Manager> solver =
        indefinite ? flexible_gmres(parameters, problem, list, *preconditioner, watch)
                   : method(problem, list, *preconditioner, watch);
      bool converged = false;
      try
        {
          converged = solver->solve() == Belos::Converged;
        }
      // Thrown by the watch in the middle of a solve: what has been done counts all the same.
      catch (const SlowConvergence &)
        {
          count.iterations += watch.iterations();
          throw;
        }
      // An indefinite matrix or preconditioner shows as a failed factorisation of
      // a 1 x 1 block; Belos derives its exceptions from logic_error.
      catch (const std::logic_error &)
        {
          count.iterations += watch.iterations();
          if (!symmetric_only() || indefinite || !preconditioner_maker->multilevel())
            throw LinearSolverFailure(
              parameters.type + " broke down: the matrix or its preconditioner is " +
              (symmetric_only() ? "not positive definite" : "singular, or not finite"));
          // Multigrid in single precision may lose its definiteness on very slender cells, where it
          // is still a good preconditioner: GMRES does not ask for it.
          remark(parameters.type + ": multigrid is not positive definite; flexible GMRES takes the "
                                   "place of conjugate gradients where it is not");
          indefinite = true;
          solution.PutScalar(0.);
          return iterate(system, solution);
        }
      count.iterations += solver->getNumIters();
      return converged ? solver->getNumIters() : -1;
    }



    // A preconditioner made for an earlier Newton iteration may fail where a new one does not, so
    // a failed solve is repeated once, from zero. With a fresh one (fresh_iterations is 0 before
    // its first solve succeeds) a repetition would be the same.
    int
    BelosSolver::iterate_or_renew(const CondensedSystem &system,
                                  const RigidMotions    &motions,
                                  Epetra_Vector         &solution)
    {
      if (!fits(system))
        set_up(system, motions);
      int iterations = iterate(system, solution);
      if (iterations < 0 && fresh_iterations > 0)
        {
          set_up(system, motions);
          solution.PutScalar(0.);
          iterations = iterate(system, solution);
        }
      return iterations;
    }



    void
    BelosSolver::do_solve(const CondensedSystem &system,
                          const RigidMotions    &motions,
                          Epetra_Vector         &solution)
    {
      if (symmetric_only() && (!system.definite || !system.symmetric))
        throw LinearSolverFailure(parameters.type + " needs a symmetric positive definite system");
      // The rigid motions are those of the displacements: other numbers of rows mean multipliers.
      if (motions.position.Map().NumGlobalElements() != system.rows().NumGlobalElements())
        throw LinearSolverFailure(parameters.type + " cannot solve a system with multipliers");
      choose(system);
      int iterations = 0;
      try
        {
          iterations = iterate_or_renew(system, motions, solution);
        }
      catch (const SlowConvergence &slowness)
        {
          // The automatic solver has its own factors, and a large system has none.
          if (parameters.patience > 0 || !factorisable(system))
            throw LinearSolverFailure(parameters.type + ": " + slowness.what());
          if (!std::exchange(told, true))
            remark(parameters.type + ": " + slowness.what() +
                   "; factors of MUMPS take its place where it does");
          slow = true;
          strikes.failed(system.symmetric);
          set_up(system, motions);
          solution.PutScalar(0.);
          iterations = iterate(system, solution);
        }
      if (!slow)
        strikes.succeeded();
      if (iterations < 0)
        throw LinearSolverFailure(parameters.type + " did not converge in " +
                                  std::to_string(parameters.maximum_iterations) + " iterations");
      // The cost of a stale preconditioner is measured against its first solve.
      if (fresh_iterations == 0)
        fresh_iterations = std::max(iterations, 1);
      else if (wants_new_set_up(iterations, fresh_iterations))
        preconditioner.reset();
      // In an unsymmetric system slow convergence may be due to one Newton iterate: the next
      // solve tries multigrid again, until it has failed for good (class Strikes).
      if (slow && !strikes.out())
        {
          preconditioner.reset();
          slow = false;
        }
    }
  } // namespace
} // namespace Touchstone
