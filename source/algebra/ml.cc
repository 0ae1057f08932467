// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/preconditioner.h>
#include <touchstone/algebra/square_operator.h>
#include <touchstone/base/non_convergence.h>

#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>
#include <string>

// The multigrid of Trilinos (ML) as a preconditioner to compare with the program's own. It reads
// the assembled matrix of doubles, and its aggregates do not know bodies.
namespace Touchstone
{
  namespace
  {
    /** Smoothed aggregation of Trilinos: levels in double precision, rows in place of blocks,
     * and aggregates that follow the couplings, also across contact surfaces.
     * Gee, Siefert, Hu, Tuminaro and Sala (2006), ML 5.0 user's guide, Sandia 2006-2649. */
    class MlOperator : public SquareOperator
    {
    public:
      MlOperator(const CondensedSystem &system, const Epetra_MultiVector &modes)
        : SquareOperator(system.rows(), "ML")
        , matrix(system.matrix())
        , modes(modes)
      {
        Teuchos::ParameterList list;
        ML_Epetra::SetDefaults("SA", list);
        list.set("ML output", 0);
        list.set("PDE equations", static_cast<int>(dim));
        list.set("null space: type", "pre-computed");
        list.set("null space: dimension", this->modes.NumVectors());
        list.set("null space: vectors", this->modes.Values());
        list.set("null space: add default vectors", false);
        // As those of the program's own multigrid.
        list.set("smoother: type", "Chebyshev");
        list.set("smoother: sweeps", 3);
        list.set("coarse: type", "Amesos-KLU");
        list.set("coarse: max size", 1000);
        ml = std::make_unique<ML_Epetra::MultiLevelPreconditioner>(*matrix, list, true);
        if (!ml->IsPreconditionerComputed())
          throw LinearSolverFailure("ML could not be set up");
      }

      int
      ApplyInverse(const Epetra_MultiVector &rhs, Epetra_MultiVector &result) const override
      {
        return ml->ApplyInverse(rhs, result);
      }

    private:
      const std::shared_ptr<Epetra_CrsMatrix> matrix;
      /** Contiguous columns, which ML refers to. */
      const Epetra_MultiVector                             modes;
      std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> ml;
    };

    class MlPreconditioner : public Preconditioner
    {
    public:
      std::unique_ptr<Epetra_Operator>
      set_up(const CondensedSystem &system, const RigidMotions &motions) const override
      {
        return std::make_unique<MlOperator>(system, near_null_space(system, motions));
      }
    };

    const PreconditionerRegistry::Entry<MlPreconditioner>
      ml_entry("ML", "smoothed aggregation of Trilinos, to compare with.");
  } // namespace
} // namespace Touchstone
