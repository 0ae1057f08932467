// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/scene/combination_rules.h>
#include <touchstone/scene/scene.h>

#include <deal.II/base/patterns.h>

namespace Touchstone
{
  std::vector<CombinationRule>
  cycle_rules(const Scene &scene)
  {
    const TimeIntegrationParameters &time = scene.time_integration;
    const std::string section = "Time integration", scheme = "'Scheme' is 'central_differences'";
    return {{time.runs_in_cycles() && scene.discretisation.degree != 1,
             "Discretisation",
             "Degree",
             std::to_string(scene.discretisation.degree),
             "lumped masses of degree 2 are negative at the corners, and " + scheme,
             "set it to 1 and take more cells"},
            {time.runs_in_cycles() && scene.refinement.active(),
             "Refinement",
             "Estimator",
             scene.refinement.estimator.word(),
             "the mesh of explicit dynamics does not change, and " + scheme,
             "set it to 'none'"},
            {time.runs_in_cycles() && time.mass != MassKind::lumped,
             section,
             "Mass",
             time.mass.word(),
             "is no diagonal matrix, and " + scheme,
             "remove the key: the mass is lumped"},
            {time.runs_in_cycles() && time.cycles.viscous() &&
               time.cycles.stable_step == ExplicitParameters::StableStepBound::power_iteration,
             section,
             "Stable step",
             time.cycles.stable_step.word(),
             "leaves no room for bulk viscosity",
             "set 'Linear bulk viscosity' and 'Quadratic bulk viscosity' to 0, or this key to "
             "'cells'"},
            {time.runs_in_cycles() && time.adapt == TimeIntegrationParameters::Adapt::impacts,
             section,
             "Adapt steps",
             time.adapt.word(),
             "cycles are as long as is stable: " + scheme,
             "remove the key"},
            {time.runs_in_cycles() && time.impact == TimeIntegrationParameters::Impact::elastic,
             section,
             "Impact",
             time.impact.word(),
             "nodes that meet lose their relative velocity in explicit dynamics",
             "remove the key"},
            {!time.runs_in_cycles() && !time.cycles.untouched(),
             section,
             "Scheme",
             time.scheme.word(),
             "has no cycles, but a key of explicit dynamics is set",
             "set it to 'central_differences', or remove 'Courant factor', 'Step check "
             "interval', 'Stable step', the bulk viscosities and mass scaling"}};
  }

  std::vector<CombinationRule>
  cycle_rules(const Scene &scene, const BodyParameters &body)
  {
    const bool        cycles    = scene.time_integration.runs_in_cycles();
    const bool        one_point = body.element() == ElementType::one_point;
    const std::string section   = body.section();
    const std::string needless  = "is a key of the element 'one point'";
    return {{one_point && !cycles,
             section,
             "Element",
             body.element_type.word(),
             "is for explicit dynamics: its stiffness is that of a single point",
             "take 'automatic', or set 'Time integration/Scheme' to 'central_differences'"},
            {one_point && body.material.thermal(),
             section + "/Material/Thermal expansion",
             "Temperature",
             body.material.temperature,
             "the element 'one point' takes no thermal strain",
             "set 'Element = automatic'"},
            {one_point && body.material.law.name == "orthotropic",
             section,
             "Element",
             body.element_type.word(),
             "has a control of hourglass modes for isotropic laws, but 'Material/Law' is "
             "'orthotropic'",
             "set it to 'automatic'"},
            {!one_point && body.hourglass != BodyParameters::Hourglass::stiffness,
             section,
             "Hourglass control",
             body.hourglass.word(),
             needless,
             "remove it, or set 'Element = one point'"},
            {cycles && body.hourglass == BodyParameters::Hourglass::viscous &&
               scene.time_integration.cycles.stable_step ==
                 ExplicitParameters::StableStepBound::power_iteration,
             section,
             "Hourglass control",
             body.hourglass.word(),
             "goes with 'Time integration/Stable step = cells' only",
             "set it to 'stiffness'"},
            {!one_point && body.hourglass_coefficient != "automatic",
             section,
             "Hourglass coefficient",
             body.hourglass_coefficient,
             needless,
             "remove it, or set 'Element = one point'"},
            {cycles && body.material.rayleigh_stiffness > 0.,
             section + "/Material",
             "Rayleigh stiffness",
             dealii::Patterns::Tools::to_string(body.material.rayleigh_stiffness),
             "would shorten the stable step of explicit dynamics beyond use",
             "take 'Rayleigh mass', or 'Time integration/Linear bulk viscosity'"}};
  }
} // namespace Touchstone
