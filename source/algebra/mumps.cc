#include <touchstone/algebra/linear_solver.h>
#include <touchstone/algebra/non_convergence.h>

#include <deal.II/base/mpi.h>

#include <Epetra_Import.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <dmumps_c.h>
#include <string>
#include <vector>

namespace Touchstone
{
  namespace
  {
    /**
     * Direct solution with MUMPS: rows stay on the ranks that own them, the
     * factorisation is LDL^T for symmetric systems and LU otherwise.
     * Amestoy, Duff, L'Excellent and Koster (2001), SIAM J. Matrix Anal. 23.
     */
    class Mumps : public LinearSolver
    {
    public:
      explicit Mumps(const LinearSolverParameters &parameters)
        : LinearSolver(parameters)
      {
      }

      ~Mumps() override
      {
        finish();
      }

      void
      forget() override
      {
        finish();
      }

    private:
      /** Numbering of the control parameters as in MUMPS' own manual. */
      int &
      icntl(const int i)
      {
        return data.icntl[i - 1];
      }
      int
      infog(const int i) const
      {
        return data.infog[i - 1];
      }

      DMUMPS_STRUC_C data        = {};
      bool           initialised = false;
      /** There are factors, of the rows, columns and values below. */
      bool                factorised = false;
      std::vector<int>    rows, columns;
      std::vector<double> values;

      /** MUMPS' name for the system: positive definite, symmetric, or neither. */
      static int
      kind(const CondensedSystem &system)
      {
        return !system.symmetric ? 0 : system.definite ? 1 : 2;
      }

      void
      start(const CondensedSystem &system);
      void
      finish();
      void
      factorise(const CondensedSystem &system);
      void
      do_solve(const CondensedSystem &system,
               const RigidMotions    &motions,
               Epetra_Vector         &solution) override;
      void
      check_pivots() const;
    };

    const LinearSolverRegistry::Entry<Mumps> entry("MUMPS", "sparse direct solver, for any system");



    void
    Mumps::start(const CondensedSystem &system)
    {
      const auto &comm  = dynamic_cast<const Epetra_MpiComm &>(system.rows().Comm());
      data.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(comm.Comm()));
      data.par          = 1; // rank 0 takes part in the factorisation
      data.sym          = kind(system);
      data.job          = -1;
      dmumps_c(&data);
      initialised = true;
      for (int i = 1; i <= 4; ++i)
        icntl(i) = (i == 4 ? 0 : -1); // no printing of its own
      icntl(14) = 40;                 // working space beyond the estimate, per cent
      icntl(18) = 3;                  // rows distributed over the ranks
      icntl(24) = 1;                  // detect null pivots
      icntl(22) = parameters.out_of_core;
      if (parameters.low_rank_tolerance > 0.)
        {
          // Amestoy, Buttari, L'Excellent and Mary (2019), ACM Trans. Math. Softw. 45.
          icntl(35)        = 2; // factors stay compressed for the solution
          data.cntl[7 - 1] = parameters.low_rank_tolerance;
        }
    }



    void
    Mumps::finish()
    {
      int finalized = 0;
      MPI_Finalized(&finalized);
      if (initialised && !finalized)
        {
          data.job = -2;
          dmumps_c(&data);
        }
      initialised = factorised = false;
    }



    void
    Mumps::factorise(const CondensedSystem &system)
    {
      const std::shared_ptr<const Epetra_CrsMatrix> assembled = system.matrix();
      const Epetra_CrsMatrix                       &matrix    = *assembled;
      std::vector<int>                              old_rows, old_columns;
      std::vector<double>                           old_values;
      rows.swap(old_rows);
      columns.swap(old_columns);
      values.swap(old_values);
      rows.reserve(old_rows.size());
      columns.reserve(old_rows.size());
      values.reserve(old_rows.size());
      for (int i = 0; i < matrix.NumMyRows(); ++i)
        {
          int     n;
          double *value;
          int    *column;
          matrix.ExtractMyRowView(i, n, value, column);
          const int row = matrix.GRID(i);
          for (int k = 0; k < n; ++k)
            {
              const int j = matrix.GCID(column[k]);
              if (system.symmetric && j > row)
                continue;
              rows.push_back(row + 1);
              columns.push_back(j + 1);
              values.push_back(value[k]);
            }
        }
      data.n       = matrix.NumGlobalRows();
      data.nnz_loc = values.size();
      data.irn_loc = rows.data();
      data.jcn_loc = columns.data();
      data.a_loc   = values.data();
      // What has not changed since the last call is not done again: nothing where
      // a linear scene repeats itself, the pattern where only normals turn.
      int same[2] = {rows == old_rows && columns == old_columns, values == old_values};
      int all_same[2];
      matrix.Comm().MinAll(same, all_same, 2);
      if (factorised && all_same[0] && all_same[1])
        return;
      data.job   = factorised && all_same[0] ? 2 : 4; // 4: with a new analysis
      factorised = false;
      dmumps_c(&data);
      // Working space too small: the estimate does not know of delayed pivots.
      while ((infog(1) == -8 || infog(1) == -9) && icntl(14) < 1000)
        {
          icntl(14) *= 2;
          data.job = 2;
          dmumps_c(&data);
        }
      ++count.factorisations;
      if (infog(1) == -10)
        throw SingularSystem("MUMPS: the matrix is numerically singular");
      if (infog(1) < 0)
        throw LinearSolverFailure(
          "MUMPS: the factorisation failed, INFOG(1) = " + std::to_string(infog(1)) +
          ", INFOG(2) = " + std::to_string(infog(2)) +
          (infog(1) == -13 ? " (not enough memory)" : ""));
      check_pivots();
      factorised = true;
    }



    void
    Mumps::check_pivots() const
    {
      if (infog(28) == 0)
        return;
      // The list of null pivots is on rank 0 only.
      std::string text;
      int         rank;
      MPI_Comm    communicator = MPI_Comm_f2c(data.comm_fortran);
      MPI_Comm_rank(communicator, &rank);
      if (rank == 0)
        for (int i = 0; i < std::min(infog(28), 5); ++i)
          {
            const int unknown = data.pivnul_list[i] - 1;
            text += std::string(i == 0 ? "" : ", ") + "node " + std::to_string(unknown / 3) +
                    " in " + "xyz"[unknown % 3];
          }
      text = dealii::Utilities::MPI::broadcast(communicator, text);
      throw SingularSystem("MUMPS found " + std::to_string(infog(28)) +
                           " null pivot(s): something can move without resistance (" + text +
                           "); give the body a support or a contact partner");
    }



    void
    Mumps::do_solve(const CondensedSystem &system, const RigidMotions &, Epetra_Vector &solution)
    {
      if (initialised && data.sym != kind(system))
        finish();
      if (!initialised)
        start(system);
      factorise(system);

      // The right-hand side is centralised: a vector is small beside the factors.
      const Epetra_Comm &comm = system.rows().Comm();
      const Epetra_Map   root(-1, comm.MyPID() == 0 ? data.n : 0, 0, comm);
      Epetra_Import      importer(root, system.rhs->Map());
      Epetra_Vector      central(root);
      central.Import(*system.rhs, importer, Insert);
      data.rhs  = central.Values();
      data.nrhs = 1;
      data.lrhs = data.n;
      data.job  = 3;
      dmumps_c(&data);
      if (infog(1) < 0)
        throw LinearSolverFailure("MUMPS: the solution failed, INFOG(1) = " +
                                  std::to_string(infog(1)));
      solution.Export(central, importer, Insert);
    }
  } // namespace
} // namespace Touchstone
