// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/scene/combination_rules.h>
#include <touchstone/scene/scene.h>

#include <deal.II/base/patterns.h>

#include <algorithm>

namespace Touchstone
{
  std::vector<CombinationRule>
  element_rules(const Scene &scene, const BodyParameters &body)
  {
    const MaterialParameters &material = body.material;
    const ElementType         type     = body.element();
    // B-bar and incompatible modes modify the small-strain operator; F-bar is their counterpart
    // at finite strain.
    const bool small_only = type == ElementType::b_bar || type == ElementType::incompatible_modes;
    const std::string section = body.section(), name = body.element_type.word(),
                      but_law = ", but 'Material/Law' is '" + material.law.name + "'";
    return {{scene.discretisation.degree > 1 && type != ElementType::full,
             section,
             "Element",
             name,
             "is made for degree 1, but 'Discretisation/Degree' is " +
               std::to_string(scene.discretisation.degree),
             "take the element 'automatic' or 'full', or degree 1"},
            {type == ElementType::incompatible_modes && !material.linear() &&
               !material.finite_strain(),
             section,
             "Element",
             name,
             (material.law.name == "linear elastic" ? "takes no thermal strain"
                                                    : "is for the law 'linear elastic'" + but_law),
             "take the element 'automatic' or 'b-bar', or degree 2"},
            {material.finite_strain() && small_only,
             section,
             "Element",
             name,
             "is for small strain" + but_law,
             "take the element 'automatic', 'F-bar' or 'full', or the law 'linear elastic'"},
            {!material.finite_strain() && type == ElementType::f_bar,
             section,
             "Element",
             name,
             "is for finite strain" + but_law,
             "take the element 'automatic', 'b-bar' or 'full', or another law"}};
  }


  std::vector<CombinationRule>
  pressure_rules(const BodyParameters &body)
  {
    using Follows = BoundaryParameters::Follows;
    std::vector<CombinationRule> rules;
    for (const auto &[name, boundary] : body.boundaries)
      rules.push_back(
        {boundary.pressure_follows == Follows::surface && !body.material.finite_strain(),
         body.section() + "/Boundary " + name,
         "Pressure follows",
         boundary.pressure_follows.word(),
         "does not go with the law '" + body.material.law.name +
           "', whose stresses do not turn with the material: what turns the pressure "
           "on a slender body would be resisted by nothing but its stiffness",
         "take a law for finite strain, for example 'neo-Hookean', or 'nothing'"});
    return rules;
  }


  std::vector<CombinationRule>
  estimate_rules(const Scene &scene)
  {
    using Estimator             = RefinementParameters::Estimator;
    const auto       &estimator = scene.refinement.estimator;
    const bool        of_forces = (estimator == Estimator::contact_force);
    const std::string remedy    = "take 'recovered stress', which estimates that of the stress";
    const auto        forced    = std::find_if(scene.obstacles.begin(),
                                     scene.obstacles.end(),
                                     [](const auto &obstacle) { return obstacle.free.any(); });
    const bool        moved     = forced != scene.obstacles.end();
    std::vector<CombinationRule> rules = {
      {of_forces && scene.pairs.empty(),
       "Refinement",
       "Estimator",
       estimator.word(),
       "estimates errors of contact forces, but there are no contact pairs",
       remedy},
      {of_forces && scene.time_integration.dynamic() && !scene.time_integration.runs_in_cycles(),
       "Refinement",
       "Estimator",
       estimator.word(),
       "estimates errors in static runs, but 'Time integration/Scheme' is '" +
         scene.time_integration.scheme.word() + "'",
       remedy},
      {of_forces && moved,
       "Refinement",
       "Estimator",
       estimator.word(),
       "estimates errors with obstacles that do not give way, but forces move '" +
         (moved ? forced->name : "") + "'",
       remedy}};
    for (const BodyParameters &body : scene.bodies)
      rules.push_back({of_forces && !body.material.linear(),
                       "Refinement",
                       "Estimator",
                       estimator.word(),
                       "estimates errors of linear bodies, but '" + body.name + "' has " +
                         (body.material.thermal() ? "thermal strain"
                                                  : "the law '" + body.material.law.name + "'"),
                       remedy});
    return rules;
  }


  std::vector<CombinationRule>
  inertia_rules(const Scene &scene, const BodyParameters &body)
  {
    const TimeIntegrationParameters &time     = scene.time_integration;
    const MaterialParameters        &material = body.material;
    const std::string                section  = body.section() + "/Material";
    std::vector<CombinationRule>     rules    = {
             {time.dynamic() && material.density <= 0.,
              section,
              "Density",
              dealii::Patterns::Tools::to_string(material.density),
              "must be positive: 'Time integration/Scheme' is '" + time.scheme.word() + "'",
              "give the mass per volume in the scene's units, e.g. 7.85e-9 for steel in t and mm, or "
                     "set the scheme to 'static'"}};
    // Keys without effect are refused, not ignored: who sets an initial velocity expects motion.
    const std::string nothing = "means nothing without inertia",
                      remedy  = "remove it, or set 'Time integration/Scheme' to 'newmark', "
                                "'generalized_alpha' or another scheme with inertia";
    // Initial conditions and damping act through inertia only.
    for (unsigned int d = 0; d < 3; ++d)
      for (const auto &[key, value] :
           {std::make_pair("Initial velocity ", &body.initial_velocity[d]),
            std::make_pair("Initial displacement ", &body.initial_displacement[d])})
        rules.push_back({!time.dynamic() && !value->empty(),
                         body.section(),
                         key + std::string(1, "xyz"[d]),
                         *value,
                         nothing,
                         remedy});
    for (const auto &[key, value] :
         {std::make_pair("Rayleigh mass", material.rayleigh_mass),
          std::make_pair("Rayleigh stiffness", material.rayleigh_stiffness)})
      rules.push_back({!time.dynamic() && value > 0.,
                       section,
                       key,
                       dealii::Patterns::Tools::to_string(value),
                       nothing,
                       remedy});
    return rules;
  }
} // namespace Touchstone
