// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_watched_iteration_h
#define touchstone_algebra_watched_iteration_h

#include <touchstone/algebra/convergence_watch.h>
#include <touchstone/algebra/square_operator.h>

#include <BelosEpetraAdapter.hpp>
#include <BelosIteration.hpp>
#include <BelosStatusTest.hpp>
#include <Epetra_MultiVector.h>
#include <Epetra_Vector.h>
#include <vector>

namespace Touchstone
{
  /** @brief Passes the residuals of conjugate gradients to a ConvergenceWatch: these apply the
   * preconditioner to their residual once an iteration. */
  class WatchedPreconditioner : public SquareOperator
  {
  public:
    WatchedPreconditioner(const Epetra_Operator &inner, ConvergenceWatch &watch)
      : SquareOperator(inner.OperatorDomainMap(), "watched preconditioner")
      , inner(inner)
      , watch(watch)
    {
    }

    int
    ApplyInverse(const Epetra_MultiVector &rhs, Epetra_MultiVector &result) const override
    {
      if (watch.wants_next())
        {
          double residual = 0.;
          rhs(0)->Norm2(&residual);
          watch.next(residual);
        }
      else
        watch.skip();
      return inner.ApplyInverse(rhs, result);
    }

  private:
    const Epetra_Operator &inner;
    ConvergenceWatch      &watch;
  };

  /** @brief Passes the residuals of GMRES to a ConvergenceWatch. It never stops the iteration as a
   * status test; the watch throws. */
  class WatchingTest : public Belos::StatusTest<double, Epetra_MultiVector, Epetra_Operator>
  {
  public:
    explicit WatchingTest(ConvergenceWatch &watch)
      : watch(watch)
    {
    }

    Belos::StatusType
    checkStatus(Belos::Iteration<double, Epetra_MultiVector, Epetra_Operator> *solver) override
    {
      std::vector<double> norms(1);
      solver->getNativeResiduals(&norms);
      watch.next(norms[0]);
      return Belos::Failed;
    }
    Belos::StatusType
    getStatus() const override
    {
      return Belos::Failed;
    }
    void
    reset() override
    {
    }
    void
    print(std::ostream &, int) const override
    {
    }

  private:
    ConvergenceWatch &watch;
  };
} // namespace Touchstone

#endif
