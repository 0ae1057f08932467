// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/drive/dynamics.h>
#include <touchstone/drive/time_integration.h>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /**
     * Quasi-static steps: equilibrium of loads, stresses and contact at each time, without inertia.
     * Time only orders the loads.
     */
    class Statics : public TimeIntegration
    {
    public:
      Statics(const Solid &solid, const Vector &committed_u)
        : solid(solid)
        , committed_u(committed_u)
        // Linear bodies start a step with an extrapolation; at finite strain it could turn cells
        // inside out.
        , guesses(solid.linear())
        , motion(solid.zero_vector())
      {
        fields = {{"motion", &motion}};
      }

      Vector
      initial_displacement() const override
      {
        return solid.zero_vector();
      }

      void
      start(const Vector &, const Vector &, const Supports &) override
      {
      }

      void
      begin_step(const double t, Vector &u) override
      {
        time = t;
        // Loads that grow in proportion to time move the bodies in proportion to it: the
        // extrapolated displacement often has the right active set already.
        if (motion.size() > 0 && guesses)
          u.add(time - committed_time, motion);
        // A vector less in the linear solver; the end of the step has another motion.
        motion.clear();
      }

      bool
      follows_supports() const override
      {
        return !failed;
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
      inertia_squared() const override
      {
        return 0.;
      }

      double
      round_off_squared(const Vector &) const override
      {
        return 0.;
      }

      Energies
      end_step(const Vector &u, const StepForces &) override
      {
        end         = committed;
        end.strain  = solid.strain_energy(u);
        end.plastic = solid.dissipation();
        if (guesses)
          {
            motion_of_step = u;
            motion_of_step -= committed_u;
          }
        return end;
      }

      void
      commit() override
      {
        // The first step closes the initial gaps: its motion says nothing of the second one.
        if (guesses && committed_time > 0.)
          {
            motion.swap(motion_of_step);
            motion *= 1. / (time - committed_time);
          }
        else
          motion = Vector(solid.zero_vector());
        motion_of_step.clear();
        failed = false;
        TimeIntegration::commit();
      }

      void
      rollback() override
      {
        // The first guess may be what made the step fail: its repetition starts at the committed
        // state.
        motion = Vector(solid.zero_vector());
        failed = true;
      }

    private:
      const Solid  &solid;
      const Vector &committed_u;
      const bool    guesses;
      /**
       * Velocity of the last step, length per time, for the extrapolation; zero if it does not
       * predict the next step. Empty from begin_step() on, which has used it, to the end of the
       * step.
       */
      Vector motion;
      /** The last attempt at this step has failed. */
      bool failed = false;
      /** Displacement of the step that end_step() has seen, length; empty once it is committed. */
      Vector motion_of_step;
    };
  } // namespace



  void
  TimeIntegration::commit()
  {
    committed      = end;
    committed_time = time;
  }



  void
  TimeIntegration::save(ArchiveWriter &archive) const
  {
    archive.put("energies", committed);
    for (const Field &field : fields)
      archive.put_field(field.name, *field.values);
  }



  void
  TimeIntegration::load(const ArchiveReader &archive)
  {
    resume(archive.get<double>("committed time"), archive.get<Energies>("energies"));
    for (const Field &field : fields)
      *field.values = archive.field(
        field.substitute.empty() || archive.has_field(field.name) ? field.name : field.substitute);
  }



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
