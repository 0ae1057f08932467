// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/multigrid/block_diagonal.h>
#include <touchstone/algebra/multigrid/multigrid.h>
#include <touchstone/algebra/preconditioner.h>

#include <memory>

// Registers the preconditioner 'multigrid', and takes the diagonal blocks in its place where
// inertia makes the system easy, as in dynamics with small steps.
namespace Touchstone
{
  namespace
  {
    /**
     * Ratio of the resistance to a translation t, t^T A t, to that of the single dofs, t^T D t,
     * in rows of dofs without conditions. Stiffness resists a translation beside constrained dofs
     * only, so the ratio is small unless there is inertia. Collective.
     */
    double
    stiffness_of_motions(const CondensedSystem &system, const RigidMotions &motions)
    {
      Epetra_Vector translation(motions.position.Map()), force(system.rhs->Map());
      for (int i = 0; i < translation.MyLength(); ++i)
        translation[i] = motions(0, i);
      system.product().Apply(translation, force);
      double sums[2] = {0., 0.}, all[2];
      for (int i = 0; i < force.MyLength(); ++i)
        if (!system.constrained[i] && !system.changed[i])
          {
            sums[0] += force[i] * translation[i];
            if (translation[i] != 0.)
              sums[1] += system.stiffness_diagonal(i) * translation[i] * translation[i];
          }
      force.Comm().SumAll(sums, all, 2);
      return all[1] > 0. ? all[0] / all[1] : 0.;
    }



    /** The program's own multigrid, in single precision on 3 x 3 blocks (class Multigrid). */
    class SmoothedAggregation : public Preconditioner
    {
    public:
      std::unique_ptr<Epetra_Operator>
      set_up(const CondensedSystem &system, const RigidMotions &motions) const override
      {
        // With much inertia it alone bounds the condition number: coarse spaces have nothing
        // to do, and the aggregates that weak couplings leave would hardly be fewer. A sweep of
        // Gauss-Seidel halves the iterations, but needs the assembled matrix and takes several
        // times as long as an iteration without.
        constexpr double much = 0.15;
        if (stiffness_of_motions(system, motions) >= much)
          return std::make_unique<BlockDiagonal>(system.rows(), *system.block_rows());
        const auto near_kernel = [&] {
          return std::make_shared<const Epetra_MultiVector>(near_null_space(system, motions));
        };
        return std::make_unique<Multigrid>(
          system.rows(), system.block_rows(), near_kernel, motions.body, system.symmetric);
      }
    };

    const PreconditionerRegistry::Entry<SmoothedAggregation>
      smoothed_aggregation_entry("multigrid",
                                 "smoothed aggregation, in whose place the factors of a matrix "
                                 "are kept where it would be slow.");
  } // namespace
} // namespace Touchstone
