// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_petsc_ksp_h
#define touchstone_algebra_petsc_ksp_h

#include <touchstone/algebra/petsc/session.h>

#include <petscksp.h>

namespace Touchstone
{
  namespace Petsc
  {
    /** @brief A KSP with all that belongs to it. */
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



    /** @brief Which method suits a system where the options do not say. */
    struct Kind
    {
      bool symmetric, definite;
    };



    /** @brief Make the KSP for the matrix of @p objects, with the options of the session.
     * @param restart Iterations between restarts of GMRES where the options do not say.
     * @throws PetscError */
    void
    make_ksp(Session     &session,
             MPI_Comm     communicator,
             Objects     &objects,
             const Kind  &kind,
             unsigned int restart);

    /** @brief Solve, from zero, with vectors that live as long as the solve.
     * @param rhs,solution The values of the rows of this rank.
     * @throws PetscError */
    void
    run(Session &session, const Objects &objects, const double *rhs, double *solution);
  } // namespace Petsc
} // namespace Touchstone

#endif
