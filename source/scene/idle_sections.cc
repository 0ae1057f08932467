// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/base/suggestion.h>
#include <touchstone/contact/friction/friction_law.h>
#include <touchstone/scene/idle_sections.h>
#include <touchstone/scene/scene.h>
#include <touchstone/scene/scene_text.h>

#include <algorithm>
#include <set>
#include <sstream>

/**
 * @file
 * Sections and keys without effect. A scene that is varied by --set has some: friction is switched
 * off, or the scheme of time integration is changed. The run goes on, but the user is told, because
 * one that was meant to act and does not gives a result that looks right.
 */

namespace Touchstone
{
  namespace
  {
    /** Keys of all friction laws. */
    std::vector<std::string>
    friction_keys()
    {
      dealii::ParameterHandler                       prm;
      std::vector<std::shared_ptr<PluginParameters>> laws;
      for (const auto &[name, record] : FrictionLawRegistry::records())
        {
          laws.push_back(record.make_parameters());
          laws.back()->declare(prm);
        }
      std::ostringstream listing;
      prm.print_parameters(listing, dealii::ParameterHandler::ShortPRM);
      std::vector<std::string> keys;
      for (const SceneEntry &entry : SceneText(listing.str(), "listing").entries())
        keys.push_back(entry.key);
      return keys;
    }

    /** Entries of @p complete with a value that is not that of @p defaults. A complete scene that
     * the program has printed sets all keys, most of them to their defaults. */
    std::vector<SceneEntry>
    changed_entries(const std::string &defaults, const std::string &complete)
    {
      const SceneText         before(defaults, "defaults"), after(complete, "scene");
      std::vector<SceneEntry> changed;
      for (const SceneEntry &entry : after.entries())
        if (entry.value != before.value(entry.section, entry.key, ""))
          changed.push_back(entry);
      return changed;
    }
  } // namespace



  std::vector<std::string>
  take_idle_friction(const Scene &scene, SceneText &text)
  {
    std::vector<std::string> sentences;
    const auto               take = [&](const auto &pair) {
      const std::string section = pair.section() + "/Friction";
      if (pair.friction || text.sections().count(section) == 0)
        return;
      const std::vector<std::string> known = friction_keys();
      for (const SceneEntry &entry : text.take(section))
        if (std::find(known.begin(), known.end(), entry.key) == known.end())
          throw InputError(section,
                           entry.key,
                           entry.value,
                           "there is no such key (" + text.location(entry.line) + ")" +
                             did_you_mean(entry.key, known),
                           "no friction law has it; the pair has no friction, so the whole "
                                         "subsection can be removed");
      // The entries are not set yet: the pair still has the default behaviour.
      sentences.push_back("section '" + section + "' has no effect: 'Behaviour' of the pair is '" +
                          text.value(pair.section(), "Behaviour", pair.behaviour.name) + "'");
    };
    for (const ContactPairParameters &pair : scene.pairs)
      take(pair);
    for (const GeneralContactParameters &one : scene.general)
      take(one);
    return sentences;
  }



  std::vector<std::string>
  idle_entries(const Scene &scene, const std::string &defaults, const std::string &complete)
  {
    const std::vector<SceneEntry> changed = changed_entries(defaults, complete);
    std::vector<std::string>      sentences;
    // Of several rules for a key the first one tells why, and the keys of a section that has no
    // effect at all need no sentences of their own.
    std::set<std::pair<std::string, std::string>> told;
    for (const IdleRule &rule : idle_rules(scene))
      {
        if (!rule.idle || told.count({rule.section, ""}) > 0 ||
            told.count({rule.section, rule.key}) > 0 ||
            std::none_of(changed.begin(), changed.end(), [&rule](const SceneEntry &entry) {
              return entry.section == rule.section && (rule.key.empty() || entry.key == rule.key);
            }))
          continue;
        told.insert({rule.section, rule.key});
        sentences.push_back(
          (rule.key.empty() ? "section '" : "key '" + rule.key + "' of section '") + rule.section +
          "' has no effect: " + rule.reason);
      }
    for (const BodyParameters &body : scene.bodies)
      for (const auto &[name, boundary] : body.boundaries)
        if (boundary.prescribes_nothing())
          sentences.push_back("boundary '" + name +
                              "' among the 'Boundary conditions' of section '" + body.section() +
                              "' has no effect: its subsection prescribes nothing");
    for (const ObstacleParameters &obstacle : scene.obstacles)
      if (std::none_of(scene.pairs.begin(), scene.pairs.end(), [&](const auto &pair) {
            return pair.obstacle == obstacle.name;
          }))
        sentences.push_back("section '" + obstacle.section() +
                            "' has no effect: no contact pair names the obstacle");
    return sentences;
  }
} // namespace Touchstone
