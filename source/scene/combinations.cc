// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/scene/combination_rules.h>
#include <touchstone/scene/combinations.h>
#include <touchstone/scene/scene.h>

namespace Touchstone
{
  namespace
  {
    /** Throw the first broken rule. */
    void
    obey(const std::vector<CombinationRule> &rules)
    {
      for (const CombinationRule &rule : rules)
        if (rule.broken)
          throw InputError(rule.section, rule.key, rule.value, rule.problem, rule.remedy);
    }
  } // namespace



  void
  check_combinations(const Scene &scene)
  {
    for (const BodyParameters &body : scene.bodies)
      {
        obey(element_rules(scene, body));
        obey(pressure_rules(body));
      }
    obey(estimate_rules(scene));
    for (const ContactPairParameters &pair : scene.pairs)
      {
        obey(pair_rules(scene, pair));
        obey(ball_rules(scene, pair));
      }
    obey(method_rules(scene));
    for (const BodyParameters &body : scene.bodies)
      obey(inertia_rules(scene, body));
    obey(cycle_rules(scene));
    for (const BodyParameters &body : scene.bodies)
      obey(cycle_rules(scene, body));
  }
} // namespace Touchstone
