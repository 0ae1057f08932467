// SPDX-License-Identifier: LGPL-2.1-or-later

#include <deal.II/base/config.h>

// Optional: the rest of the program does not know of this file. deal.II, where it has PETSc,
// initialises and finalises it with MPI.
#ifdef DEAL_II_WITH_PETSC

#  include <touchstone/algebra/convergence_watch.h>
#  include <touchstone/algebra/linear_solver.h>
#  include <touchstone/algebra/petsc/ksp.h>
#  include <touchstone/algebra/petsc/matrices.h>
#  include <touchstone/algebra/petsc/session.h>
#  include <touchstone/base/input_error.h>
#  include <touchstone/base/non_convergence.h>

#  include <Epetra_MpiComm.h>
#  include <algorithm>
#  include <memory>
#  include <petscksp.h>
#  include <sstream>
#  include <string>
#  include <vector>

#  ifndef PETSC_USE_COMPLEX

// All solvers and preconditioners of PETSc behind one name: the user chooses by PETSc's own
// options, and what these leave open is set so that the result meets the same checks as that of
// other solvers (doc/theory.md, section 8). The condensed matrix is copied to PETSc's format
// before each solve; the preconditioner is kept while the same dofs are constrained, as in
// belos.cc.
namespace Touchstone
{
  using namespace Petsc;

  namespace
  {
    class PetscKeys : public PluginParameters
    {
    public:
      std::string text;

      void
      declare(dealii::ParameterHandler &prm) override
      {
        prm.add_parameter(
          "PETSc options",
          text,
          "As on the command line of a program with PETSc, for its KSP and PC: '-pc_type hypre "
          "-ksp_monitor'. Empty: conjugate gradients for symmetric systems and GMRES for others, "
          "both with GAMG, and MUMPS for systems with multipliers. Multigrid knows the rigid "
          "motions of the bodies.",
          dealii::Patterns::Anything());
      }

      /**
       * Solve a small system with the options when the input is read: PETSc reports wrong values
       * only where it uses them, which otherwise would be after the mesh has been made. Options
       * that were not used are spelled wrong, or have no effect beside the others.
       */
      void
      check(const std::string &section) const override
      {
        const auto refuse = [&](const std::string &value, const std::string &reason) {
          throw InputError(section,
                           "PETSc options",
                           value,
                           reason,
                           "see the options of KSP and PC in PETSc's manual pages, or leave the "
                           "key empty");
        };
        std::vector<std::string> unused;
        try
          {
            const OptionsDatabase database(text);
            Session               session(&database);
            Objects               objects;
            objects.matrix = make_sample(session);
            make_ksp(session, PETSC_COMM_SELF, objects, Kind{true, true}, 30);
            PetscInt n = 0;
            session.check(MatGetLocalSize(objects.matrix, &n, nullptr));
            const std::vector<double> rhs(n, 1.);
            std::vector<double>       solution(n);
            session.check(KSPSetUp(objects.ksp));
            run(session, objects, rhs.data(), solution.data());
            unused = database.unused();
          }
        catch (const PetscError &error)
          {
            refuse(text, "PETSc: " + std::string(error.what()));
          }
        // Options of single levels (-mg_...) are accepted, for the sample has fewer levels than a
        // large system.
        for (const std::string &name : unused)
          if (name.rfind("-mg_", 0) != 0)
            refuse(name, "PETSc has no such option, or does not use it beside the others");
      }
    };

    const LinearSolverOptionsRegistry::Entry<PetscKeys> petsc_keys_entry("PETSc",
                                                                         "options of PETSc");



    /**
     * Whether @p text sets the option @p name to one of @p values; the last occurrence counts, as
     * for PETSc. Read from the text, since what a solver can do is asked before PETSc objects
     * exist.
     */
    bool
    sets(const std::string &text, const std::string &name, const std::vector<std::string> &values)
    {
      std::istringstream words(text);
      std::string        last;
      bool               result = false;
      for (std::string word; words >> word; last = word)
        if (last == name)
          result = std::find(values.begin(), values.end(), word) != values.end();
      return result;
    }



    /** Solvers of PETSc, as its options choose them. Balay et al., PETSc/TAO users manual,
     * ANL-21/39. */
    class PetscSolver : public LinearSolver
    {
    public:
      explicit PetscSolver(const LinearSolverParameters &parameters)
        : LinearSolver(parameters)
        , text(parameters.options_of<PetscKeys>("PETSc").text)
      {
      }

      bool
      symmetric_only() const override
      {
        return sets(text, "-ksp_type", {"cg", "fcg", "groppcg", "pipecg", "minres"});
      }

      bool
      factorises(int) const override
      {
        return sets(text, "-pc_type", {"lu", "cholesky"});
      }

      bool
      wants_basis_change(const int n_dofs) const override
      {
        return !factorises(n_dofs);
      }

      void
      clear_cache() override
      {
        kept.reset();
      }

    private:
      const std::string                text;
      std::unique_ptr<OptionsDatabase> database;
      std::unique_ptr<Objects>         kept;
      /** Constrained dofs of the system for which the preconditioner was set up, and those of
       * changed basis; and the iterations that the first solve with it took. */
      std::vector<bool> constrained, changed;
      PetscInt          fresh_iterations = 0;

      void
      do_solve(const CondensedSystem &system,
               const RigidMotions    &motions,
               Epetra_Vector         &solution) override
      {
        try
          {
            if (!database)
              database = std::make_unique<OptionsDatabase>(text);
            Session session(database.get());
            if (!fits(system))
              kept.reset();
            // A preconditioner of an earlier Newton iteration may have failed: try once more with
            // a new one.
            const bool fresh = !kept;
            if (!try_to_solve(session, system, motions, solution) && !fresh)
              {
                kept.reset();
                solution.PutScalar(0.);
                try_to_solve(session, system, motions, solution);
              }
            judge(session);
          }
        catch (const PetscError &error)
          {
            throw LinearSolverFailure("PETSc: " + std::string(error.what()));
          }
        for (const std::string &name : database->unused())
          remark("PETSc does not use the option " + name);
      }

      /** Whether the preconditioner of the last solve still serves. Collective. */
      bool
      fits(const CondensedSystem &system) const
      {
        int same =
          kept && system.definite && constrained == system.constrained && changed == system.changed;
        int all_same = 0;
        system.rows().Comm().MinAll(&same, &all_same, 1);
        return all_same == 1;
      }

      /** @return Whether it converged. */
      bool
      try_to_solve(Session               &session,
                   const CondensedSystem &system,
                   const RigidMotions    &motions,
                   Epetra_Vector         &solution)
      {
        const MPI_Comm communicator =
          dynamic_cast<const Epetra_MpiComm &>(system.rows().Comm()).Comm();
        const Kind kind{system.symmetric, system.definite};
        const bool fresh = !kept;
        if (fresh)
          kept = std::make_unique<Objects>();
        // The matrix is new in each Newton iteration, the preconditioner (in the KSP) is not.
        MatDestroy(&kept->matrix);
        kept->matrix = convert(session, communicator, *system.matrix(), kind);
        if (fresh)
          {
            if (kind.definite)
              set_near_null_space(session,
                                  communicator,
                                  kept->matrix,
                                  near_null_space(system, motions));
            make_ksp(session, communicator, *kept, kind, parameters.restart);
            constrained      = system.constrained;
            changed          = system.changed;
            fresh_iterations = 0;
          }
        session.check(KSPSetOperators(kept->ksp, kept->matrix, kept->matrix));
        session.check(KSPSetReusePreconditioner(kept->ksp, fresh ? PETSC_FALSE : PETSC_TRUE));
        set_tolerance(session, system.tolerance);
        if (fresh)
          {
            session.check(KSPSetUp(kept->ksp));
            count_set_up(session);
          }

        run(session, *kept, system.rhs->Values(), solution.Values());

        PetscInt           iterations = 0;
        KSPConvergedReason reason     = KSP_CONVERGED_ITERATING;
        session.check(KSPGetIterationNumber(kept->ksp, &iterations));
        session.check(KSPGetConvergedReason(kept->ksp, &reason));
        // With KSPPREONLY the preconditioner is the solution, a factorisation: no iteration.
        KSPType type = nullptr;
        session.check(KSPGetType(kept->ksp, &type));
        if (std::string(type) != KSPPREONLY)
          count.iterations += static_cast<unsigned int>(iterations);
        if (fresh_iterations == 0)
          fresh_iterations = std::max<PetscInt>(iterations, 1);
        stale = wants_new_set_up(iterations, fresh_iterations);
        return reason > 0;
      }

      /**
       * The tolerance and the maximum of iterations are those of the options, if given, and
       * otherwise those of Newton's method and of the input. The absolute tolerance is switched
       * off: forces have no natural scale.
       */
      void
      set_tolerance(Session &session, const double tolerance)
      {
        PetscReal own   = 0.;
        PetscBool given = PETSC_FALSE;
        session.check(PetscOptionsGetReal(database->data, nullptr, "-ksp_rtol", &own, &given));
        PetscInt  most       = 0;
        PetscBool given_most = PETSC_FALSE;
        session.check(
          PetscOptionsGetInt(database->data, nullptr, "-ksp_max_it", &most, &given_most));
        session.check(KSPSetTolerances(kept->ksp,
                                       given ? own : tolerance,
                                       1e-300,
                                       PETSC_DEFAULT,
                                       given_most
                                         ? most
                                         : static_cast<PetscInt>(parameters.maximum_iterations)));
      }

      void
      count_set_up(Session &session)
      {
        PC     pc   = nullptr;
        PCType type = nullptr;
        session.check(KSPGetPC(kept->ksp, &pc));
        session.check(PCGetType(pc, &type));
        if (std::string(type) == PCLU || std::string(type) == PCCHOLESKY)
          ++count.factorisations;
        else
          ++count.preconditioner_setups;
      }

      // The present preconditioner has become too slow and is dropped after the solve.
      bool stale = false;

      /** @throws LinearSolverFailure if the last solve did not converge. */
      void
      judge(Session &session)
      {
        PetscInt           iterations = 0;
        KSPConvergedReason reason     = KSP_CONVERGED_ITERATING;
        session.check(KSPGetIterationNumber(kept->ksp, &iterations));
        session.check(KSPGetConvergedReason(kept->ksp, &reason));
        if (reason <= 0)
          throw LinearSolverFailure("PETSc did not converge in " + std::to_string(iterations) +
                                    " iterations (" + KSPConvergedReasons[reason] + ")");
        if (stale)
          kept.reset();
      }
    };

    const LinearSolverRegistry::Entry<PetscSolver>
      petsc_entry("PETSc", "what 'PETSc options' say, for any system.");
  } // namespace
} // namespace Touchstone

#  endif
#endif
