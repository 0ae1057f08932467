// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/mumps_factors.h>
#include <touchstone/base/non_convergence.h>

#include <deal.II/base/mpi.h>

#include <Epetra_Import.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <algorithm>

// The calls of MUMPS, in its order: start (job -1), analysis and factorisation (4, or 2 with the
// analysis of before), solution (3), end (-2). All are collective, and INFOG is the same on all
// ranks, so errors can be thrown from it without further communication. Numbers of ICNTL and
// INFOG are those of its manual.
namespace Touchstone
{
  MumpsFactors::MumpsFactors(const double low_rank_tolerance, const bool out_of_core)
    : low_rank_tolerance(low_rank_tolerance)
    , out_of_core(out_of_core)
  {
  }



  MumpsFactors::~MumpsFactors()
  {
    clear();
  }



  void
  MumpsFactors::clear()
  {
    // A solver may live longer than MPI, as a static object does: then MUMPS must not be called
    // any more.
    int finalized = 0;
    MPI_Finalized(&finalized);
    if (initialised && !finalized)
      {
        data.job = -2;
        dmumps_c(&data);
      }
    initialised = factorised = false;
    release_matrix();
  }



  void
  MumpsFactors::release_matrix()
  {
    rows    = {};
    columns = {};
    values  = {};
  }



  // Texts for the codes that users meet; the numbers go along for those in its manual.
  std::string
  MumpsFactors::reason(const int infog1, const int infog2)
  {
    std::string text;
    switch (infog1)
      {
        case -5:
        case -7:
        case -13:
          text = "not enough memory; try 'Out of core = true', more ranks, or an iterative solver";
          break;
        case -8:
        case -9:
        case -11:
        case -14:
        case -15:
        case -17:
        case -19:
        case -20:
          text = "its working space is too small";
          break;
        case -6:
        case -10:
          text = "the matrix is singular";
          break;
        case -40:
          text = "the matrix is not positive definite";
          break;
        case -51:
        case -52:
          text = "the system is too large for integers of 32 bits";
          break;
        case -90:
          text = "its files (out of core) could not be written or read";
          break;
        default:
          text = "see the manual of MUMPS";
      }
    return text + " (INFOG(1) = " + std::to_string(infog1) +
           ", INFOG(2) = " + std::to_string(infog2) + ")";
  }



  void
  MumpsFactors::start(const Epetra_CrsMatrix &matrix, const Kind kind)
  {
    const auto &comm  = dynamic_cast<const Epetra_MpiComm &>(matrix.Comm());
    data.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(comm.Comm()));
    data.par          = 1; // rank 0 takes part in the factorisation
    // Set before job -1, and fixed from then on: another kind needs a new instance (factorise()).
    data.sym = static_cast<MUMPS_INT>(kind);
    data.job = -1;
    dmumps_c(&data);
    initialised = true;
    for (int i = 1; i <= 4; ++i)
      icntl(i) = (i == 4 ? 0 : -1); // no printing of its own
    icntl(14) = 40;                 // working space beyond the estimate, per cent
    icntl(18) = 3;                  // rows distributed over the ranks
    icntl(24) = 1;                  // detect null pivots
    icntl(22) = out_of_core;
    if (low_rank_tolerance > 0.)
      {
        // Amestoy, Buttari, L'Excellent and Mary (2019), ACM Trans. Math. Softw. 45.
        icntl(35)        = 2; // factors stay compressed for the solution
        data.cntl[7 - 1] = low_rank_tolerance;
      }
  }



  // The rows of this rank as triplets, numbered from one. Of symmetric matrices MUMPS wants one
  // triangle, and would add an entry of the other to it.
  void
  MumpsFactors::read(const Epetra_CrsMatrix &matrix)
  {
    rows.clear();
    columns.clear();
    values.clear();
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
            if (data.sym != static_cast<MUMPS_INT>(Kind::unsymmetric) && j > row)
              continue;
            rows.push_back(row + 1);
            columns.push_back(j + 1);
            values.push_back(value[k]);
          }
      }
    data.n       = matrix.NumGlobalRows();
    data.nnz_loc = static_cast<MUMPS_INT8>(values.size());
    data.irn_loc = rows.data();
    data.jcn_loc = columns.data();
    data.a_loc   = values.data();
  }



  // Factorise only what is needed. The kind can change between solves, as when friction makes the
  // system unsymmetric, and then MUMPS is started anew.
  bool
  MumpsFactors::factorise(const Epetra_CrsMatrix &matrix,
                          const Kind              kind,
                          const int               n_displacements)
  {
    if (initialised && data.sym != static_cast<MUMPS_INT>(kind))
      clear();
    if (!initialised)
      start(matrix, kind);
    // The matrix of the last call is moved aside and compared with the new one, entry by entry:
    // the copy is needed anyway, as MUMPS does not copy its input.
    std::vector<int>    old_rows, old_columns;
    std::vector<double> old_values;
    rows.swap(old_rows);
    columns.swap(old_columns);
    values.swap(old_values);
    rows.reserve(old_rows.size());
    columns.reserve(old_rows.size());
    values.reserve(old_rows.size());
    read(matrix);
    // What has not changed since the last call is not done again: with the same values nothing,
    // as where a linear scene repeats itself; with the same pattern no analysis, as where only
    // normals turn. All ranks must agree, since each of the steps is collective.
    int same[2] = {rows == old_rows && columns == old_columns, values == old_values};
    int all_same[2];
    matrix.Comm().MinAll(same, all_same, 2);
    if (factorised && all_same[0] && all_same[1])
      return false;
    data.job   = factorised && all_same[0] ? 2 : 4; // 4: with a new analysis
    factorised = false;
    dmumps_c(&data);
    // If the working space is too small the factorisation is repeated with twice as much: the
    // estimate of the analysis does not know of delayed pivots, which indefinite systems with
    // multipliers have many of.
    while ((infog(1) == -8 || infog(1) == -9) && icntl(14) < 1000)
      {
        icntl(14) *= 2;
        data.job = 2;
        dmumps_c(&data);
      }
    // A singular matrix is a missing support rather than a numerical failure: an exception of its
    // own.
    if (infog(1) == -6 || infog(1) == -10)
      throw SingularSystem("MUMPS: " + reason(infog(1), infog(2)));
    if (infog(1) < 0)
      throw LinearSolverFailure("MUMPS: the factorisation failed: " + reason(infog(1), infog(2)));
    check_pivots(n_displacements);
    factorised = true;
    return true;
  }



  // With ICNTL(24) MUMPS replaces null pivots and goes on, with one of the infinitely many
  // solutions; here they are an error that names the nodes, since they mean a missing support
  // (doc/theory.md, section 8).
  void
  MumpsFactors::check_pivots(const int n_displacements) const
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
          const int dof = data.pivnul_list[i] - 1;
          text += (i == 0 ? "" : ", ");
          if (dof < n_displacements)
            text += "node " + std::to_string(dof / 3) + " in " + "xyz"[dof % 3];
          else
            text += "a contact force, whose condition others imply";
        }
    text = dealii::Utilities::MPI::broadcast(communicator, text);
    throw SingularSystem("MUMPS found " + std::to_string(infog(28)) +
                         " null pivot(s): something can move without resistance (" + text +
                         "); give the body a support or a contact partner");
  }



  void
  MumpsFactors::solve(const Epetra_Vector &rhs, Epetra_Vector &solution)
  {
    // The right-hand side goes to rank 0 and the solution comes back from there: a vector is
    // small beside the factors.
    const Epetra_Comm &comm = rhs.Comm();
    const Epetra_Map   root(-1, comm.MyPID() == 0 ? data.n : 0, 0, comm);
    Epetra_Import      importer(root, rhs.Map());
    Epetra_Vector      central(root);
    central.Import(rhs, importer, Insert);
    data.rhs  = central.Values();
    data.nrhs = 1;
    data.lrhs = data.n;
    data.job  = 3;
    dmumps_c(&data);
    if (infog(1) < 0)
      throw LinearSolverFailure("MUMPS: the solution failed: " + reason(infog(1), infog(2)));
    solution.Export(central, importer, Insert);
  }
} // namespace Touchstone
