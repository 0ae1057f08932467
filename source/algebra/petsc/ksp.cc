// SPDX-License-Identifier: LGPL-2.1-or-later

#include <deal.II/base/config.h>

#ifdef DEAL_II_WITH_PETSC

#  include <touchstone/algebra/petsc/ksp.h>

#  include <algorithm>
#  include <string>
#  include <vector>

#  ifndef PETSC_USE_COMPLEX

namespace Touchstone
{
  namespace Petsc
  {
    namespace
    {
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
        if (one_of(pc_type, {PCLU, PCCHOLESKY}) &&
            !has_option(session, "-pc_factor_mat_solver_type"))
          session.check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
      }
    } // namespace



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
  } // namespace Petsc
} // namespace Touchstone

#  endif
#endif
