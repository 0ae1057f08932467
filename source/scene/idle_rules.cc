// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/enforcement/enforcement.h>
#include <touchstone/scene/idle_sections.h>
#include <touchstone/scene/scene.h>

#include <algorithm>

// Which sections and keys have no effect in a scene, whole sections first. What an enforcement acts
// on it says itself (Enforcement::keys(), ImpulseRule::keys()).
namespace Touchstone
{
  namespace
  {
    using Rules = std::vector<IdleRule>;

    void
    add_sections(const Scene &scene, Rules &rules)
    {
      const bool        cycles          = scene.time_integration.runs_in_cycles();
      const std::string explicit_scheme = "explicit dynamics solves no systems of equations";
      rules.push_back({!scene.has_contact(), "Contact", "", "there are no contact pairs"});
      rules.push_back({cycles, "Newton", "", explicit_scheme});
      rules.push_back({cycles, "Linear solver", "", explicit_scheme});
      rules.push_back(
        {cycles, "Load stepping", "Maximum cuts", "cycles of explicit dynamics are not cut"});
      rules.push_back({!scene.refinement.active(), "Refinement", "", "its 'Estimator' is 'none'"});
      rules.push_back(
        {scene.reference.type.name == "none", "Reference solution", "", "its 'Type' is 'none'"});
    }



    void
    add_time_integration(const TimeIntegrationParameters &time, Rules &rules)
    {
      using Scheme              = TimeIntegrationParameters::Scheme;
      const std::string section = "Time integration";
      const std::string scheme  = "'Scheme' is '" + time.scheme.word() + "'";
      for (const char *const key : {"Newmark gamma", "Newmark beta"})
        rules.push_back({time.scheme != Scheme::newmark, section, key, scheme});
      rules.push_back({time.scheme != Scheme::hht, section, "HHT alpha", scheme});
      rules.push_back(
        {time.scheme != Scheme::generalized_alpha && time.scheme != Scheme::contact_stabilized,
         section,
         "Spectral radius",
         scheme});
      for (const char *const key : {"Mass", "Impact", "Adapt steps", "Gain tolerance"})
        rules.push_back({!time.dynamic(), section, key, scheme});
      rules.push_back({time.runs_in_cycles() && time.cycles.mass_scaling_step == 0.,
                       section,
                       "Largest added mass",
                       "'Mass scaling step' is 0"});
      const bool implicit = time.dynamic() && !time.runs_in_cycles();
      for (const char *const key : {"Impact tolerance", "Smallest step"})
        {
          rules.push_back({!implicit, section, key, scheme});
          rules.push_back({!time.adapts_to_impacts(),
                           section,
                           key,
                           "steps are not shortened to end at impacts ('Adapt steps', 'Impact')"});
        }
    }



    void
    add_contact(const Scene &scene, Rules &rules)
    {
      const ContactParameters &contact   = scene.contact;
      const bool               cycles    = scene.time_integration.runs_in_cycles();
      const auto               made      = contact.enforcement.make(contact);
      const std::string        section   = "Contact";
      const std::string        by_method = "'Enforcement' is '" + contact.enforcement.name +
                                    (cycles ? "', in explicit dynamics" : "'");
      // One that does not serve explicit steps is refused elsewhere.
      const std::vector<std::string> used = !cycles                ? made->keys()
                                            : made->impulse_rule() ? made->impulse_rule()->keys()
                                                                   : std::vector<std::string>();
      const auto                     acts = [&used](const char *const key) {
        return std::find(used.begin(), used.end(), key) != used.end();
      };
      for (const char *const key :
           {"Penalty factor", "Augmentation", "Contact tolerance", "Contact iterations"})
        rules.push_back({!acts(key), section, key, by_method});
      for (const char *const key : {"Friction", "Tangential factor"})
        rules.push_back({!scene.has_friction(), section, key, "no pair has friction"});
      const bool regularised = !cycles && contact.friction == ContactParameters::Stick::regularised;
      rules.push_back({!regularised && !acts("Tangential factor"),
                       section,
                       "Tangential factor",
                       cycles ? by_method : by_method + " and 'Friction' is 'exact'"});
      for (const char *const key : {"Friction", "Linearisation"})
        rules.push_back({cycles, section, key, "explicit dynamics solves no systems of equations"});
    }



    void
    add_pair(const ContactPairParameters &pair, Rules &rules)
    {
      const std::string section = pair.section();
      for (const char *const key : {"Pairing",
                                    "Sliding",
                                    "Contact geometry",
                                    "Master normal",
                                    "Search distance",
                                    "Edge tolerance"})
        rules.push_back(
          {!pair.obstacle.empty(), section, key, "the pair meets an obstacle, which has no faces"});
    }



    void
    add_body(const BodyParameters &body, Rules &rules)
    {
      rules.push_back({body.hourglass == BodyParameters::Hourglass::none,
                       body.section(),
                       "Hourglass coefficient",
                       "'Hourglass control' is 'none'"});
    }



    /** Inertia of an obstacle that forces move; of others it is refused. */
    void
    add_obstacle(const Scene &scene, const ObstacleParameters &obstacle, Rules &rules)
    {
      const FreeMotionParameters      &free = obstacle.free;
      const TimeIntegrationParameters &time = scene.time_integration;
      const bool        moves               = free.is_free(0) || free.is_free(1) || free.is_free(2);
      const std::string section             = obstacle.section(),
                        scheme = "'Time integration/Scheme' is '" + time.scheme.word() + "'";
      for (const char *const key : {"Mass", "Inertia"})
        rules.push_back({!time.dynamic(), section, key, scheme});
      rules.push_back({!moves, section, "Mass", "no axis is among its 'Free directions'"});
      rules.push_back(
        {!free.turns(), section, "Inertia", "no turn is among its 'Free directions'"});
    }



    void
    add_output(const OutputParameters &output, Rules &rules)
    {
      for (const char *const key : {"Format", "Unsmoothed values"})
        rules.push_back(
          {output.vtu_interval == 0,
           "Output",
           key,
           "'VTU interval' is 0, so that only a run that fails writes its last state"});
    }
  } // namespace



  std::vector<IdleRule>
  idle_rules(const Scene &scene)
  {
    Rules rules;
    add_sections(scene, rules);
    add_time_integration(scene.time_integration, rules);
    add_contact(scene, rules);
    for (const ContactPairParameters &pair : scene.pairs)
      add_pair(pair, rules);
    for (const BodyParameters &body : scene.bodies)
      add_body(body, rules);
    for (const ObstacleParameters &obstacle : scene.obstacles)
      add_obstacle(scene, obstacle, rules);
    add_output(scene.output, rules);
    return rules;
  }
} // namespace Touchstone
