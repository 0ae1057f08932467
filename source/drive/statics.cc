// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/dynamics.h>
#include <touchstone/drive/time_integration.h>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Equilibrium at each time: no inertia. */
    class Statics : public TimeIntegration
    {
    public:
      Statics(const Solid &solid, const Vector &committed_u)
        : solid(solid)
        , committed_u(committed_u)
        // With friction the stick and slip of a step begin where the last one ended;
        // and finite strains may not bear a guess.
        , guesses(solid.linear())
        , motion(solid.owned, solid.communicator)
      {
      }

      Vector
      initial_displacement() const override
      {
        return Vector(solid.owned, solid.communicator);
      }

      void
      start(const Vector &, const Vector &, const Supports &) override
      {
      }

      void
      begin_step(const double t, Vector &u) override
      {
        time = t;
        // The last step's motion is likely to go on.
        if (guesses)
          u.add(time - committed_time, motion);
      }

      void
      balance(const Vector &, const Vector &external, const Vector &internal, Vector &sum) override
      {
        sum = external;
        sum -= internal;
      }

      const Matrix &
      stiffness() override
      {
        return solid.stiffness();
      }

      double
      weight() const override
      {
        return 1.;
      }

      bool
      dynamic() const override
      {
        return false;
      }

      double
      inertia() const override
      {
        return 0.;
      }

      double
      round_off(const Vector &) const override
      {
        return 0.;
      }

      Energies
      end_step(const Vector &u, const StepForces &) override
      {
        Energies result = committed;
        result.strain   = solid.strain_energy(u);
        result.plastic  = solid.dissipation();
        return result;
      }

      void
      commit(const Vector &u, const StepForces &, const Energies &end) override
      {
        committed = end;
        // The first step is no motion that goes on.
        if (guesses && committed_time > 0.)
          {
            motion = u;
            motion -= committed_u;
            motion *= 1. / (time - committed_time);
          }
        committed_time = time;
      }

      void
      rollback() override
      {
        motion = 0.;
      }

      std::vector<std::pair<std::string, Vector *>>
      state() override
      {
        return {{"motion", &motion}};
      }

    private:
      const Solid  &solid;
      const Vector &committed_u;
      const bool    guesses;
      double        time = 0.;
      /** The motion of the last step per time; zero where it says nothing of the next
       * one. */
      Vector motion;
    };
  } // namespace



  void
  TimeIntegration::resume(const double time, const Energies &energies)
  {
    committed_time = time;
    committed      = energies;
  }



  std::unique_ptr<TimeIntegration>
  TimeIntegration::make(const TimeIntegrationParameters &parameters,
                        const double                     step,
                        const Solid                     &solid,
                        const std::set<Index>           &slaves,
                        const Vector                    &committed_u)
  {
    if (parameters.dynamic())
      return std::make_unique<Dynamics>(parameters, step, solid, slaves, committed_u);
    return std::make_unique<Statics>(solid, committed_u);
  }
} // namespace Touchstone
