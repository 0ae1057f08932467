// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/verification/reference_solution.h>

#include <cmath>

namespace Touchstone
{
  namespace
  {
    /**
     * @brief Two equal elastic bars that meet end on, without lateral contraction.
     *
     * d'Alembert's solution of the wave equation: from the impact, waves run through both
     * bars with c = sqrt(E / rho) and the stress rho c v / 2, where v is the relative
     * speed; they come back from the free ends as waves that release, and after 2 L / c the
     * bars part with exchanged velocities and no strain. Goldsmith (1960), Impact, ch. 3.
     */
    class BarImpact : public ReferenceSolution
    {
    public:
      explicit BarImpact(const Scene &scene)
        : pair(reference_pair(scene))
      {
        // Speeds are those along x, with their signs; only their difference matters for the stress.
        ReferenceValues values(scene.reference.values);
        length       = values.positive_number("length");
        area         = values.positive_number("area");
        slave_speed  = values.number("slave speed");
        master_speed = values.number("master speed");
        values.finish();
        if (slave_speed == master_speed)
          values.fail("the bars have the same speed", "give different speeds along the bars");
        if (!scene.time_integration.dynamic())
          throw InputError("Reference solution",
                           "Type",
                           scene.reference.type.name,
                           "needs bodies with inertia",
                           "set 'Time integration/Scheme' to another value than 'static'");
        const ContactPairParameters &parameters = scene.pairs[pair];
        slave                                   = parameters.slave_body;
        master                                  = parameters.master_body;
        name                                    = parameters.name;
        const MaterialParameters &material      = scene.bodies[scene.body_index(slave)].material;
        // With Poisson's ratio 0 the three-dimensional bars follow the one-dimensional wave
        // equation exactly.
        if (material.poisson_ratio != 0.)
          throw InputError("Body " + slave + "/Material",
                           "Poisson ratio",
                           std::to_string(material.poisson_ratio),
                           "the exact solution has no lateral contraction",
                           "set it to 0");
        // Wave speed c = sqrt(E / rho). Each bar takes half of the relative speed: stress rho c v /
        // 2; the bars part when the waves come back from the free ends, after 2 L / c.
        const double wave = std::sqrt(material.young_modulus / material.density);
        stress            = 0.5 * material.density * wave * std::abs(slave_speed - master_speed);
        duration          = 2. * length / wave;
      }

      ReferenceComparison
      compare(const ReferenceInput &input) const override
      {
        ReferenceComparison   result;
        const Motion::Impact &impact   = input.motion->impacts.at(name);
        const Energies       &energies = input.motion->energies;
        const double          time     = impact.end - impact.begin;
        const double          speed    = std::abs(slave_speed - master_speed);
        // Mean stress as impulse over area and duration: insensitive to oscillations of the contact
        // force, which the overshoot measures.
        result.add("contact_stress",
                   "contact stress, mean over time",
                   time > 0. ? impact.impulse.norm() / (area * time) : 0.,
                   stress);
        result.add("contact_duration", "duration of contact", time, duration);
        result.add("stress_overshoot",
                   "contact stress, largest over time",
                   impact.peak_force / area,
                   stress);
        // Equal bars exchange their velocities. Motion across the axis counts as an error, too.
        const auto velocity_error = [&](const std::string &body, const double expected) {
          dealii::Tensor<1, dim> v        = input.motion->velocities.at(body);
          const double           sideways = std::hypot(v[1], v[2]);
          return std::hypot(v[0] - expected, sideways) / speed;
        };
        result.add("slave_velocity",
                   "velocity of the slave, over the relative speed",
                   velocity_error(slave, master_speed));
        result.add("master_velocity",
                   "velocity of the master, over the relative speed",
                   velocity_error(master, slave_speed));
        result.add("energy",
                   "energy of the bars after the impact",
                   energies.present(),
                   energies.initial);
        // Chatter: contact that opens more than once.
        result.add("openings", "openings of the contact but one", impact.openings - 1.);
        return result;
      }

    private:
      const unsigned int pair;
      double             length, area, slave_speed, master_speed, stress, duration;
      std::string        slave, master, name;
    };

    const ReferenceRegistry::Entry<BarImpact> bar_impact_entry(
      "bar impact",
      "two equal bars along x that meet end on, Poisson's ratio 0; values: length, area, "
      "slave speed, master speed (along x).");
  } // namespace
} // namespace Touchstone
