// SPDX-License-Identifier: LGPL-2.1-or-later

#include <deal.II/base/config.h>

#ifdef DEAL_II_WITH_PETSC

#  include <touchstone/algebra/petsc/matrices.h>
#  include <touchstone/base/types.h>

#  include <deal.II/base/mpi.h>

#  include <Epetra_Import.h>
#  include <Epetra_IntVector.h>
#  include <algorithm>
#  include <vector>

#  ifndef PETSC_USE_COMPLEX

namespace Touchstone
{
  namespace Petsc
  {
    namespace
    {
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
    } // namespace



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
  } // namespace Petsc
} // namespace Touchstone

#  endif
#endif
