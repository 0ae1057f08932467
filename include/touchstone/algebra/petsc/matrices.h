// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_petsc_matrices_h
#define touchstone_algebra_petsc_matrices_h

#include <touchstone/algebra/petsc/ksp.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_MultiVector.h>
#include <petscksp.h>

// Matrices and near null spaces in PETSc's format.
namespace Touchstone
{
  namespace Petsc
  {
    /** @brief The condensed matrix as one of PETSc, to be destroyed by the caller. Multipliers,
     * which have numbers behind all displacements in the program, follow those of their rank.
     * @throws PetscError
     * Collective. */
    Mat
    convert(Session                &session,
            MPI_Comm                communicator,
            const Epetra_CrsMatrix &matrix,
            const Kind             &kind);

    /**
     * @brief Tell PETSc's multigrid of the near null space, from which it makes its coarse levels.
     * PETSc wants it orthonormal: Gram-Schmidt, in which modes that constraints have made dependent
     * are dropped.
     * @param modes Values of the rows of this rank, a column each.
     * @throws PetscError
     * Collective.
     */
    void
    set_near_null_space(Session                  &session,
                        MPI_Comm                  communicator,
                        Mat                       matrix,
                        const Epetra_MultiVector &modes);

    /**
     * @brief Stiffness of springs between the neighbouring nodes of a cube of 6^3 nodes, on this
     * rank alone, for the check of options: small, but large enough for two levels of multigrid.
     * Springs are three times as stiff along their axis as across it, and 0.1 on the diagonal
     * makes it positive definite; no unit.
     */
    Mat
    make_sample(Session &session);
  } // namespace Petsc
} // namespace Touchstone

#endif
