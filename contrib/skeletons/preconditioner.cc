// SPDX-License-Identifier: LGPL-2.1-or-later
// A preconditioner to start from. Copy to source/algebra/NAME.cc and change what is marked
// TODO: 'set Preconditioner = NAME' selects it, and nothing else need be edited.

#include <touchstone/algebra/preconditioner.h>
#include <touchstone/algebra/square_operator.h>
#include <touchstone/base/non_convergence.h>

#include <Ifpack_ILU.h>

namespace Touchstone
{
  namespace
  {
    /** TODO: what it is: here incomplete factors, on each rank of its own rows and columns. */
    class IncompleteFactors : public SquareOperator
    {
    public:
      explicit IncompleteFactors(const CondensedSystem &system)
        : SquareOperator(system.rows(), "incomplete LU")
        , matrix(system.matrix())
        , ilu(matrix.get())
      {
        // TODO: the set-up; it fails by this exception, and then the step is cut.
        if (ilu.Initialize() != 0 || ilu.Compute() != 0)
          throw LinearSolverFailure("the incomplete factors could not be made");
      }

      int
      ApplyInverse(const Epetra_MultiVector &rhs, Epetra_MultiVector &result) const override
      {
        return ilu.ApplyInverse(rhs, result);
      }

    private:
      const std::shared_ptr<Epetra_CrsMatrix> matrix;
      Ifpack_ILU                              ilu;
    };

    class IncompleteFactorisation : public Preconditioner
    {
    public:
      std::unique_ptr<Epetra_Operator>
      set_up(const CondensedSystem &system, const RigidMotions &) const override
      {
        return std::make_unique<IncompleteFactors>(system);
      }

      // TODO: whether iterations hardly depend on the mesh.
      bool
      multilevel() const override
      {
        return false;
      }
    };

    // TODO: the name that scenes use, and a sentence for the reference of keys.
    const PreconditionerRegistry::Entry<IncompleteFactorisation>
      incomplete_factorisation("incomplete LU", "incomplete factors of each rank's own rows.");
  } // namespace
} // namespace Touchstone
