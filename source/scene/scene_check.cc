// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/formula.h>
#include <touchstone/base/input_error.h>
#include <touchstone/base/suggestion.h>
#include <touchstone/scene/combinations.h>
#include <touchstone/scene/free_motion_rules.h>
#include <touchstone/scene/scene.h>
#include <touchstone/solid/thermal_strain.h>

#include <algorithm>

/**
 * @file
 * Checks of a scene that need all of it: names that refer to each other, and formulas at all steps.
 * Sections check themselves first, so that combinations can rely on valid values.
 */

namespace Touchstone
{
  namespace
  {
    /** Names of bodies, obstacles or pairs, for messages and look-up. */
    template <class Parameters>
    std::vector<std::string>
    names(const std::vector<Parameters> &all)
    {
      std::vector<std::string> result;
      for (const Parameters &one : all)
        result.push_back(one.name);
      return result;
    }

    /** Throw unless @p name, given as @p key of @p section, is in the list of known names. */
    void
    check_name(const std::string              &section,
               const std::string              &key,
               const std::string              &name,
               const std::string              &list,
               const std::vector<std::string> &known)
    {
      if (std::find(known.begin(), known.end(), name) == known.end())
        throw InputError(section,
                         key,
                         name,
                         "the list '" + list + "' does not name it" + did_you_mean(name, known),
                         known.empty() ? "add it to the list, which is empty"
                                       : "take one of " + quoted_list(known));
    }
  } // namespace



  void
  Scene::check() const
  {
    discretisation.check("Discretisation");
    for (const BodyParameters &body : bodies)
      body.check();
    for (const ObstacleParameters &obstacle : obstacles)
      obstacle.check(obstacle.section());
    for (const ContactPairParameters &pair : pairs)
      check_pair(pair);
    for (const GeneralContactParameters &one : general)
      check_general(one);
    contact.check("Contact");
    refinement.check("Refinement");
    load_stepping.check("Load stepping");
    check_formulas();
    time_integration.check("Time integration");
    newton.check("Newton");
    linear_solver.check("Linear solver");
    output.check("Output");
    for (const ProbeParameters &probe : probes)
      {
        check_name(probe.section(), "Body", probe.body, "Bodies", names(bodies));
        probe.check();
      }
    check_combinations(*this);
    check_free_motions(*this);
    check_reference();
  }



  void
  Scene::check_reference() const
  {
    reference.check("Reference solution");
    if (!reference.pair.empty())
      check_name("Reference solution", "Pair", reference.pair, "Contact pairs", names(pairs));
    // Formulas of a reference solution that is not of this type would be ignored, and the user
    // would believe them compared.
    if (reference.type.name == "formula")
      return;
    const auto no_formula =
      [&](const std::string &section, const std::string &key, const std::string &text) {
        if (!text.empty())
          throw InputError(section,
                           key,
                           text,
                           "means nothing while 'Reference solution/Type' is '" +
                             reference.type.name + "'",
                           "remove it, or set that type to 'formula'");
      };
    no_formula("Reference solution", "Pressure", reference.pressure);
    for (const BodyParameters &body : bodies)
      for (unsigned int d = 0; d < 3; ++d)
        no_formula(body.section(),
                   std::string("Reference displacement ") + "xyz"[d],
                   body.reference_displacement[d]);
  }



  void
  Scene::check_formulas() const
  {
    // Formulas of time alone can be evaluated at all steps without a mesh: a division by zero at
    // the last step is found now and not after hours. Those that depend on position are checked
    // where they are evaluated (Formulas::check).
    const std::vector<double> times = load_stepping.step_ends();
    const auto                check =
      [&](const std::string &section, const std::string &key, const std::string &text) {
        check_at_all_steps(section, key, text, times);
      };
    for (const BodyParameters &body : bodies)
      {
        for (unsigned int d = 0; d < 3; ++d)
          check(body.section(), std::string("Body force ") + "xyz"[d], body.body_force[d]);
        check_at_all_steps(body.section() + "/Material/Thermal expansion",
                           "Temperature",
                           body.material.temperature,
                           times,
                           possible_temperatures(body.material));
        for (const auto &[boundary, condition] : body.boundaries)
          for (const auto &[key, text] : condition.formulas())
            check(body.section() + "/Boundary " + boundary, key, text);
      }
    for (const ContactPairParameters &pair : pairs)
      {
        check(pair.section(), "Pretension force", pair.pretension_force);
        check(pair.section(), "Pretension shortening", pair.pretension_shortening);
      }
    for (const ObstacleParameters &obstacle : obstacles)
      for (const auto &[key, text] : {std::make_pair("Motion x", &obstacle.motion_x),
                                      std::make_pair("Motion y", &obstacle.motion_y),
                                      std::make_pair("Motion z", &obstacle.motion_z),
                                      std::make_pair("Rotate angle", &obstacle.rotate_angle)})
        check(obstacle.section(), key, *text);
    for (const ObstacleParameters &obstacle : obstacles)
      for (unsigned int c = 0; c < FreeMotionParameters::n_components; ++c)
        check(obstacle.section(), FreeMotionParameters::load_key(c), obstacle.free.loads[c]);
  }



  void
  Scene::check_general(const GeneralContactParameters &one) const
  {
    const std::string section = one.section();
    if (general.size() > 1)
      throw InputError(
        "",
        "Contact pairs",
        general[1].name,
        "as '" + general[0].name +
          "' it has neither a master body nor an obstacle, and there can be only one "
          "general contact",
        "name the bodies of both in one of them, or give this one a master body");
    if (!one.all_bodies())
      for (const std::string &body : one.bodies)
        check_name(section, "Slave body", body, "Bodies", names(bodies));
    one.check(section);
  }



  void
  Scene::check_pair(const ContactPairParameters &pair) const
  {
    const std::string section = pair.section();
    check_name(section, "Slave body", pair.slave_body, "Bodies", names(bodies));
    if (!pair.master_body.empty())
      check_name(section, "Master body", pair.master_body, "Bodies", names(bodies));
    if (!pair.obstacle.empty())
      check_name(section, "Obstacle", pair.obstacle, "Obstacles", names(obstacles));
    pair.check(section);
  }
} // namespace Touchstone
