// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/explicit_parameters.h>

// Keys of explicit dynamics (doc/explicit.md, section 1).
namespace Touchstone
{
  namespace Patterns = dealii::Patterns;

  void
  ExplicitParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
      "Courant factor",
      courant_factor,
      "Of 'central_differences': length of a cycle as a part of the largest one that "
      "is stable. [no unit]",
      Patterns::Double(1e-3, 10.));
    stable_step.declare(prm,
                        "Stable step",
                        "Of 'central_differences': the largest step that is stable for each of the "
                        "'cells' by itself; or, by 'power iteration' at the start of each output "
                        "interval, for all of them together, which is longer on regular meshes. "
                        "The latter is for laws without history, and without bulk viscosity.");
    prm.add_parameter(
      "Step check interval",
      check_interval,
      "Of 'central_differences': most cycles after which the stable step is computed "
      "anew. [no unit]",
      Patterns::Integer(1));
    prm.add_parameter("Linear bulk viscosity",
                      linear_viscosity,
                      "Of 'central_differences': damping of changes of volume that are as fast as "
                      "the mesh can represent, as a part of the critical one; 0 for none. It takes "
                      "the ringing behind fronts of waves. [no unit]",
                      Patterns::Double(0., 10.));
    prm.add_parameter("Quadratic bulk viscosity",
                      quadratic_viscosity,
                      "Of 'central_differences': pressure against compression that grows with the "
                      "square of its rate, which spreads shocks over some cells; 0 for none. [no "
                      "unit]",
                      Patterns::Double(0., 10.));
    prm.add_parameter("Mass scaling step",
                      mass_scaling_step,
                      "Of 'central_differences': cells that need shorter cycles than this get more "
                      "mass at the start, which has inertia but no weight; 0 for none. [time]",
                      Patterns::Double(0.));
    prm.add_parameter(
      "Largest added mass",
      largest_added_mass,
      "Of 'central_differences': mass that 'Mass scaling step' may add, relative to "
      "that of all bodies; what needs more is refused. [no unit]",
      Patterns::Double(0.));
  }



  bool
  ExplicitParameters::untouched() const
  {
    const ExplicitParameters defaults;
    return courant_factor == defaults.courant_factor && stable_step == defaults.stable_step &&
           check_interval == defaults.check_interval &&
           linear_viscosity == defaults.linear_viscosity &&
           quadratic_viscosity == defaults.quadratic_viscosity &&
           mass_scaling_step == defaults.mass_scaling_step &&
           largest_added_mass == defaults.largest_added_mass;
  }
} // namespace Touchstone
