// SPDX-License-Identifier: LGPL-2.1-or-later

#include <deal.II/base/config.h>

// Optional: the rest of the program does not know of this file. deal.II, where it has PETSc,
// initialises and finalises it with MPI.
#ifdef DEAL_II_WITH_PETSC

#  include <touchstone/algebra/linear_solver.h>
#  include <touchstone/base/input_error.h>
#  include <touchstone/base/non_convergence.h>

#  include <Epetra_Import.h>
#  include <Epetra_IntVector.h>
#  include <Epetra_MpiComm.h>
#  include <algorithm>
#  include <cmath>
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
  namespace
  {
    /** An error of PETSc, with the first line of its message. */
    class PetscError : public std::runtime_error
    {
      using std::runtime_error::runtime_error;
    };



    /**
     * Options as on PETSc's command line, in a database of their own: the global one belongs to
     * the process, and two solvers with different options must not mix theirs.
     */
    class OptionsDatabase
    {
    public:
      explicit OptionsDatabase(const std::string &text);

      ~OptionsDatabase()
      {
        PetscOptionsDestroy(&data);
      }

      OptionsDatabase(const OptionsDatabase &) = delete;
      OptionsDatabase &
      operator=(const OptionsDatabase &) = delete;

      /** Names of those that nothing has asked for. */
      std::vector<std::string>
      unused() const;

      PetscOptions data = nullptr;
    };



    /**
     * A scope in which PETSc is called. It makes PETSc read the options of one database only, and
     * keeps the first line of an error instead of printing it, so that check() can throw it. C
     * functions on the way must not be left by an exception, hence the two stages.
     */
    class Session
    {
    public:
      /** @param options Null: those of the process. */
      explicit Session(const OptionsDatabase *options)
        : pushed(options != nullptr)
      {
        PetscPushErrorHandler(&keep, this);
        if (pushed)
          PetscOptionsPush(options->data);
      }

      ~Session()
      {
        if (pushed)
          PetscOptionsPop();
        PetscPopErrorHandler();
      }

      Session(const Session &) = delete;
      Session &
      operator=(const Session &) = delete;

      /** @throws PetscError if @p error is one. */
      void
      check(const PetscErrorCode error)
      {
        if (error != 0)
          throw PetscError(message.empty() ? "error " + std::to_string(static_cast<int>(error))
                                           : message);
      }

    private:
      const bool  pushed;
      std::string message;

      static PetscErrorCode
      keep(MPI_Comm,
           int,
           const char *,
           const char *,
           PetscErrorCode error,
           PetscErrorType type,
           const char    *text,
           void          *self)
      {
        // Each function on the way back reports the error again; the first report has the reason.
        if (type == PETSC_ERROR_INITIAL && text)
          {
            std::string first                     = text;
            first                                 = first.substr(0, first.find('\n'));
            static_cast<Session *>(self)->message = first;
          }
        return error;
      }
    };



    OptionsDatabase::OptionsDatabase(const std::string &text)
    {
      Session session(nullptr);
      session.check(PetscOptionsCreate(&data));
      session.check(PetscOptionsInsertString(data, text.c_str()));
      // BoomerAMG (hypre) takes interpolation vectors, here the rigid motions, into account only
      // with a nodal coarsening and a variant of vector interpolation: the defaults below.
      const auto text_of = [&](const char *name) {
        char      value[64] = "";
        PetscBool given     = PETSC_FALSE;
        session.check(PetscOptionsGetString(data, nullptr, name, value, sizeof(value), &given));
        return std::string(value);
      };
      const std::string hypre_type = text_of("-pc_hypre_type");
      if (text_of("-pc_type") == "hypre" && (hypre_type.empty() || hypre_type == "boomeramg"))
        for (const auto &[name, value] :
             {std::make_pair("-pc_hypre_boomeramg_nodal_coarsen", "6"),
              std::make_pair("-pc_hypre_boomeramg_vec_interp_variant", "2")})
          if (text_of(name).empty())
            session.check(PetscOptionsSetValue(data, name, value));
    }



    std::vector<std::string>
    OptionsDatabase::unused() const
    {
      PetscInt                 n = 0;
      char                   **names, **values;
      std::vector<std::string> result;
      if (PetscOptionsLeftGet(data, &n, &names, &values) != 0)
        return result;
      for (PetscInt k = 0; k < n; ++k)
        result.push_back("-" + std::string(names[k]));
      PetscOptionsLeftRestore(data, &n, &names, &values);
      return result;
    }



    /** A KSP with all that belongs to it. */
    struct Objects
    {
      KSP ksp    = nullptr;
      Mat matrix = nullptr;

      ~Objects()
      {
        KSPDestroy(&ksp);
        MatDestroy(&matrix);
      }
    };



    /** Which method suits a system where the options do not say. */
    struct Kind
    {
      bool symmetric, definite;
    };

    /** Whether the present options have @p name. */
    bool
    has_option(Session &session, const char *name)
    {
      PetscBool given = PETSC_FALSE;
      session.check(PetscOptionsHasName(nullptr, nullptr, name, &given));
      return given == PETSC_TRUE;
    }



    /** What the options leave open. The residual that a method judges should be the true one:
     * conjugate gradients know that, others if they are preconditioned from the right. And
     * factors are those of MUMPS, for PETSc has none of its own on several ranks. */
    void
    complete_options(Session &session, const Objects &objects, const unsigned int restart)
    {
      KSPType ksp_type = nullptr;
      PCType  pc_type  = nullptr;
      PC      pc       = nullptr;
      session.check(KSPGetPC(objects.ksp, &pc));
      session.check(KSPGetType(objects.ksp, &ksp_type));
      session.check(PCGetType(pc, &pc_type));
      const auto one_of = [](const std::string &type, const std::vector<std::string> &types) {
        return std::find(types.begin(), types.end(), type) != types.end();
      };
      // Preconditioned from the right or by conjugate gradients in the unpreconditioned norm, the
      // tolerance holds for the true residual; from the left, GMRES judges the preconditioned
      // one.
      const bool from_right = one_of(ksp_type, {KSPGMRES, KSPFGMRES, KSPLGMRES, KSPBCGS});
      const bool own_side   = has_option(session, "-ksp_pc_side");
      if (from_right && !own_side)
        session.check(KSPSetPCSide(objects.ksp, PC_RIGHT));
      if ((from_right || one_of(ksp_type, {KSPCG, KSPFCG})) && !own_side &&
          !has_option(session, "-ksp_norm_type"))
        session.check(KSPSetNormType(objects.ksp, KSP_NORM_UNPRECONDITIONED));
      if (!has_option(session, "-ksp_gmres_restart"))
        session.check(KSPGMRESSetRestart(objects.ksp, static_cast<PetscInt>(restart)));
      if (one_of(pc_type, {PCLU, PCCHOLESKY}) && !has_option(session, "-pc_factor_mat_solver_type"))
        session.check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
    }



    /** Make the KSP for the matrix of @p objects, with the present options. */
    void
    make_ksp(Session           &session,
             const MPI_Comm     communicator,
             Objects           &objects,
             const Kind        &kind,
             const unsigned int restart)
    {
      PC pc = nullptr;
      session.check(KSPCreate(communicator, &objects.ksp));
      session.check(KSPSetOperators(objects.ksp, objects.matrix, objects.matrix));
      session.check(KSPGetPC(objects.ksp, &pc));
      // Defaults: Krylov methods with PETSc's multigrid (GAMG) for definite systems, and factors
      // for those with multipliers, on which multigrid fails.
      if (kind.definite)
        {
          session.check(KSPSetType(objects.ksp, kind.symmetric ? KSPCG : KSPGMRES));
          session.check(PCSetType(pc, PCGAMG));
        }
      else
        {
          session.check(KSPSetType(objects.ksp, KSPPREONLY));
          session.check(PCSetType(pc, kind.symmetric ? PCCHOLESKY : PCLU));
        }
      // Options override these defaults; complete_options() must follow, since it depends on the
      // types that were chosen.
      session.check(KSPSetFromOptions(objects.ksp));
      complete_options(session, objects, restart);
    }



    /** Solve, from zero, with vectors that live as long as the solve. */
    void
    run(Session &session, const Objects &objects, const double *rhs, double *solution)
    {
      Vec      b = nullptr, x = nullptr;
      PetscInt n      = 0;
      double  *values = nullptr;
      session.check(MatCreateVecs(objects.matrix, &x, &b));
      session.check(VecGetLocalSize(b, &n));
      session.check(VecGetArray(b, &values));
      std::copy(rhs, rhs + n, values);
      session.check(VecRestoreArray(b, &values));
      session.check(KSPSolve(objects.ksp, b, x));
      session.check(VecGetArray(x, &values));
      std::copy(values, values + n, solution);
      session.check(VecRestoreArray(x, &values));
      session.check(VecDestroy(&b));
      session.check(VecDestroy(&x));
    }



    /**
     * An empty matrix. PETSc numbers the rows of each rank consecutively. The numbers of entries
     * per row in columns of this rank and of others let it allocate once, without which insertion
     * is slow; blocks of three let GAMG and BoomerAMG treat nodes.
     */
    Mat
    make_matrix(Session                     &session,
                const MPI_Comm               communicator,
                const std::vector<PetscInt> &n_here,
                const std::vector<PetscInt> &n_elsewhere,
                const bool                   of_nodes)
    {
      Mat            matrix = nullptr;
      const PetscInt n      = static_cast<PetscInt>(n_here.size());
      session.check(MatCreate(communicator, &matrix));
      session.check(MatSetSizes(matrix, n, n, PETSC_DETERMINE, PETSC_DETERMINE));
      session.check(MatSetType(matrix, MATAIJ));
      if (of_nodes)
        session.check(MatSetBlockSize(matrix, dim));
      session.check(MatSeqAIJSetPreallocation(matrix, 0, n_here.data()));
      session.check(MatMPIAIJSetPreallocation(matrix, 0, n_here.data(), 0, n_elsewhere.data()));
      return matrix;
    }



    /** The condensed matrix as one of PETSc. Multipliers, which have numbers behind all
     * displacements in the program, follow those of their rank. */
    Mat
    convert(Session                &session,
            const MPI_Comm          communicator,
            const Epetra_CrsMatrix &matrix,
            const Kind             &kind)
    {
      // New numbers by a prefix sum over the ranks; those of columns on other ranks come by the
      // importer that Epetra uses for products. MPI_Exscan leaves the result of rank 0 undefined.
      const int        n     = matrix.NumMyRows();
      int              first = 0;
      Epetra_IntVector own(matrix.RowMap()), all(matrix.ColMap());
      MPI_Exscan(&n, &first, 1, MPI_INT, MPI_SUM, communicator);
      if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
        first = 0;
      for (int i = 0; i < n; ++i)
        own[i] = first + i;
      if (matrix.Importer())
        all.Import(own, *matrix.Importer(), Insert);
      else
        std::copy(own.Values(), own.Values() + n, all.Values());

      // First count, then insert.
      std::vector<PetscInt> n_here(n, 0), n_elsewhere(n, 0), columns;
      int                   count   = 0;
      int                  *indices = nullptr;
      double               *values  = nullptr;
      for (int i = 0; i < n; ++i)
        {
          matrix.ExtractMyRowView(i, count, values, indices);
          for (int k = 0; k < count; ++k)
            ++(all[indices[k]] >= first && all[indices[k]] < first + n ? n_here : n_elsewhere)[i];
        }
      const Mat result = make_matrix(session, communicator, n_here, n_elsewhere, kind.definite);
      for (int i = 0; i < n; ++i)
        {
          matrix.ExtractMyRowView(i, count, values, indices);
          columns.clear();
          for (int k = 0; k < count; ++k)
            columns.push_back(all[indices[k]]);
          const PetscInt row = first + i;
          session.check(
            MatSetValues(result, 1, &row, count, columns.data(), values, INSERT_VALUES));
        }
      session.check(MatAssemblyBegin(result, MAT_FINAL_ASSEMBLY));
      session.check(MatAssemblyEnd(result, MAT_FINAL_ASSEMBLY));
      session.check(MatSetOption(result, MAT_SYMMETRIC, kind.symmetric ? PETSC_TRUE : PETSC_FALSE));
      if (kind.symmetric && kind.definite)
        session.check(MatSetOption(result, MAT_SPD, PETSC_TRUE));
      return result;
    }



    /**
     * Tell PETSc's multigrid of the near null space, from which it makes its coarse levels. PETSc
     * wants it orthonormal: Gram-Schmidt, in which modes that constraints have made dependent are
     * dropped. Collective.
     */
    void
    set_near_null_space(Session                  &session,
                        const MPI_Comm            communicator,
                        const Mat                 matrix,
                        const Epetra_MultiVector &modes)
    {
      constexpr double dependent = 1e-8;
      std::vector<Vec> columns;
      for (int v = 0; v < modes.NumVectors(); ++v)
        {
          Vec       column = nullptr;
          PetscReal before = 0., after = 0.;
          session.check(MatCreateVecs(matrix, &column, nullptr));
          double *values = nullptr;
          session.check(VecGetArray(column, &values));
          std::copy(modes[v], modes[v] + modes.MyLength(), values);
          session.check(VecRestoreArray(column, &values));
          session.check(VecNorm(column, NORM_2, &before));
          // A second sweep removes what round-off leaves of nearly parallel modes.
          for (unsigned int sweep = 0; sweep < 2; ++sweep)
            for (const Vec earlier : columns)
              {
                PetscScalar along = 0.;
                session.check(VecDot(column, earlier, &along));
                session.check(VecAXPY(column, -along, earlier));
              }
          session.check(VecNormalize(column, &after));
          if (after > dependent * before)
            columns.push_back(column);
          else
            session.check(VecDestroy(&column));
        }
      MatNullSpace space = nullptr;
      session.check(MatNullSpaceCreate(
        communicator, PETSC_FALSE, static_cast<PetscInt>(columns.size()), columns.data(), &space));
      session.check(MatSetNearNullSpace(matrix, space));
      session.check(MatNullSpaceDestroy(&space));
      for (Vec &column : columns)
        session.check(VecDestroy(&column));
    }



    /**
     * Stiffness of springs between the neighbouring nodes of a cube of 6^3 nodes, on this rank
     * alone, for the check of options: small, but large enough for two levels of multigrid.
     * Springs are three times as stiff along their axis as across it, and 0.1 on the diagonal
     * makes it positive definite; no unit.
     */
    Mat
    make_sample(Session &session)
    {
      constexpr PetscInt          side = 6, n = dim * side * side * side;
      const std::vector<PetscInt> n_here(n, 7), n_elsewhere(n, 0);
      const Mat matrix = make_matrix(session, PETSC_COMM_SELF, n_here, n_elsewhere, true);
      for (PetscInt i = 0; i < n; ++i)
        {
          double   diagonal = 0.1;
          PetscInt stride   = 1;
          for (PetscInt d = 0; d < static_cast<PetscInt>(dim); ++d, stride *= side)
            for (const PetscInt step : {-1, 1})
              if (const PetscInt at = i / dim / stride % side + step; at >= 0 && at < side)
                {
                  const double k = d == i % static_cast<PetscInt>(dim) ? 3. : 1.;
                  diagonal += k;
                  session.check(MatSetValue(
                    matrix, i, i + step * stride * static_cast<PetscInt>(dim), -k, INSERT_VALUES));
                }
          session.check(MatSetValue(matrix, i, i, diagonal, INSERT_VALUES));
        }
      session.check(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
      session.check(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
      session.check(MatSetOption(matrix, MAT_SPD, PETSC_TRUE));
      return matrix;
    }



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
      std::vector<char> constrained, changed;
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
        // As in belos.cc: half as many iterations again are worth a new set-up.
        stale = iterations > fresh_iterations * 3 / 2 + 5;
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
