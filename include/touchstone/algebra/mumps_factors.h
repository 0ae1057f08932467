// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_mumps_factors_h
#define touchstone_algebra_mumps_factors_h

#include <Epetra_CrsMatrix.h>
#include <Epetra_Vector.h>
#include <dmumps_c.h>
#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The factors of a distributed matrix, by MUMPS: rows stay on the ranks that own
   * them.
   *
   * Amestoy, Duff, L'Excellent and Koster (2001), SIAM J. Matrix Anal. 23.
   */
  class MumpsFactors
  {
  public:
    /** @brief What is known of a matrix; the numbers are those of MUMPS. */
    enum class Kind
    {
      unsymmetric = 0, // LU
      definite    = 1, // LDL^T without pivoting
      symmetric   = 2  // LDL^T
    };

    /**
     * @param low_rank_tolerance Relative size of what is left out of the blocks of the factors; 0
     *                           keeps all; no unit.
     * @param out_of_core        Keep the factors in files.
     */
    MumpsFactors(double low_rank_tolerance, bool out_of_core);

    ~MumpsFactors();

    MumpsFactors(const MumpsFactors &) = delete;
    MumpsFactors &
    operator=(const MumpsFactors &) = delete;

    /**
     * @brief Factorise; nothing is done if pattern and values are those of the last call,
     * and no new analysis if the pattern is. Collective.
     * @param n_displacements Rows from this one on belong to contact forces; for messages.
     * @return Whether there was something to do.
     * @throws SingularSystem, LinearSolverFailure on all ranks; there are no factors then.
     */
    bool
    factorise(const Epetra_CrsMatrix &matrix, Kind kind, int n_displacements);

    /** @brief Solve with the factors. Collective. @throws LinearSolverFailure on all ranks. */
    void
    solve(const Epetra_Vector &rhs, Epetra_Vector &solution);

    /** @brief Free the copy of the matrix with which factorise() compares the next one to find
     * out what has changed. */
    void
    release_matrix();

    /** @brief Free the factors. Collective. */
    void
    clear();

    /** @brief The reason that MUMPS gives by INFOG(1) and INFOG(2), in words. */
    static std::string
    reason(int infog1, int infog2);

  private:
    const double low_rank_tolerance;
    const bool   out_of_core;

    DMUMPS_STRUC_C data        = {};
    bool           initialised = false;
    /** There are factors, of the rows, columns and values below. */
    bool                factorised = false;
    std::vector<int>    rows, columns;
    std::vector<double> values;

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

    void
    start(const Epetra_CrsMatrix &matrix, Kind kind);
    void
    read(const Epetra_CrsMatrix &matrix);
    void
    check_pivots(int n_displacements) const;
  };
} // namespace Touchstone

#endif
