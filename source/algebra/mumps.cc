// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/linear_solver.h>
#include <touchstone/algebra/mumps_factors.h>

// The direct solver: its keys and its registration; MUMPS itself is called in mumps_factors.cc.
namespace Touchstone
{
  namespace
  {
    /** Keys of MUMPS. */
    class MumpsOptions : public PluginParameters
    {
    public:
      /** Relative size of what is left out of the blocks of the factors; 0 keeps all; no
       * unit. */
      double low_rank_tolerance = 0.;
      /** The factors are kept in files. */
      bool out_of_core = false;

      void
      declare(dealii::ParameterHandler &prm) override
      {
        prm.add_parameter(
          "Low rank tolerance",
          low_rank_tolerance,
          "MUMPS compresses the blocks of its factors, up to this relative error: less "
          "memory for large models, at about the same time; 0: not at all. 1e-8 costs no "
          "Newton iteration. [no unit]",
          dealii::Patterns::Double(0., 1e-2));
        prm.add_parameter("Out of core",
                          out_of_core,
                          "MUMPS keeps its factors in files, in the folder that the environment "
                          "variable MUMPS_OOC_TMPDIR names or in /tmp: for models that memory has "
                          "no room for.",
                          dealii::Patterns::Bool());
      }
    };

    const LinearSolverOptionsRegistry::Entry<MumpsOptions> mumps_options_entry("MUMPS",
                                                                               "keys of MUMPS");



    /**
     * Direct solution: LDL^T for symmetric systems and LU otherwise. The factors are kept and
     * reused as long as the matrix is unchanged (MumpsFactors::factorise()).
     */
    class Mumps : public LinearSolver
    {
    public:
      explicit Mumps(const LinearSolverParameters &parameters)
        : LinearSolver(parameters)
        , factors(parameters.options_of<MumpsOptions>("MUMPS").low_rank_tolerance,
                  parameters.options_of<MumpsOptions>("MUMPS").out_of_core)
      {
      }

      bool
      factorises(int) const override
      {
        return true;
      }

      void
      clear_cache() override
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
        // What is known of the matrix saves work: a definite one needs no pivoting, a symmetric
        // one half of the memory.
        const auto kind = !system.symmetric ? MumpsFactors::Kind::unsymmetric
                          : system.definite ? MumpsFactors::Kind::definite
                                            : MumpsFactors::Kind::symmetric;
        count.factorisations += factors.factorise(*system.matrix(), kind, system.n_displacements());
        factors.solve(*system.rhs, solution);
      }
    };

    const LinearSolverRegistry::Entry<Mumps>
      mumps_entry("MUMPS", "factorises any system, for small models and multipliers.");
  } // namespace
} // namespace Touchstone
