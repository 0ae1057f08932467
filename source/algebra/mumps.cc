#include <touchstone/algebra/linear_solver.h>
#include <touchstone/algebra/mumps_factors.h>

namespace Touchstone
{
  namespace
  {
    /** Direct solution: LDL^T for symmetric systems and LU otherwise. */
    class Mumps : public LinearSolver
    {
    public:
      explicit Mumps(const LinearSolverParameters &parameters)
        : LinearSolver(parameters)
        , factors(parameters.low_rank_tolerance, parameters.out_of_core)
      {
      }

      bool
      factorises(int) const override
      {
        return true;
      }

      void
      forget() override
      {
        factors.clear();
      }

    private:
      MumpsFactors factors;

      void
      do_solve(const CondensedSystem &system,
               const RigidMotions &,
               Epetra_Vector &solution) override
      {
        const auto kind = !system.symmetric ? MumpsFactors::Kind::unsymmetric
                          : system.definite ? MumpsFactors::Kind::definite
                                            : MumpsFactors::Kind::symmetric;
        count.factorisations += factors.factorise(*system.matrix(), kind);
        factors.solve(*system.rhs, solution);
      }
    };

    const LinearSolverRegistry::Entry<Mumps> mumps_entry("MUMPS",
                                                         "sparse direct solver, for any system");
  } // namespace
} // namespace Touchstone
