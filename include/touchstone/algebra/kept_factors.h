// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_kept_factors_h
#define touchstone_algebra_kept_factors_h

#include <touchstone/algebra/condensed_system.h>
#include <touchstone/algebra/mumps_factors.h>
#include <touchstone/algebra/square_operator.h>

namespace Touchstone
{
  /**
   * @brief The factors of a matrix as the preconditioner of others that are like it: those of later
   * Newton iterations with the same contact rows.
   *
   * For systems that multigrid is slow with. Near incompressibility the stiffness against a
   * change of volume couples all nodes of a cell, and neither smoothers of single nodes nor
   * aggregates with rigid motions alone can keep volumes: Schoeberl (1999), Numer. Math. 84.
   */
  class KeptFactors : public SquareOperator
  {
  public:
    /** @throws SingularSystem, LinearSolverFailure on all ranks. Collective. */
    explicit KeptFactors(const CondensedSystem &system);

    int
    ApplyInverse(const Epetra_MultiVector &rhs, Epetra_MultiVector &result) const override;

  private:
    mutable MumpsFactors factors;
  };
} // namespace Touchstone

#endif
