// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/scene/combination_rules.h>
#include <touchstone/scene/scene.h>

#include <deal.II/base/patterns.h>

#include <algorithm>

namespace Touchstone
{
  std::vector<CombinationRule>
  pair_rules(const Scene &scene, const ContactPairParameters &pair)
  {
    const std::string section = pair.section();
    return {{pair.tied() && pair.initial_overlap != ContactPairParameters::Overlap::interference,
             section,
             "Initial overlap",
             pair.initial_overlap.word(),
             "a tied pair holds the bodies as they are placed",
             "remove the key"},
            {pair.ramp_end > 0. && pair.initial_overlap != ContactPairParameters::Overlap::ramp,
             section,
             "Overlap end time",
             dealii::Patterns::Tools::to_string(pair.ramp_end),
             "means nothing while 'Initial overlap' is '" + pair.initial_overlap.word() + "'",
             "remove it, or set 'Initial overlap' to 'ramp'"},
            {pair.ramp_end > scene.load_stepping.end_time,
             section,
             "Overlap end time",
             dealii::Patterns::Tools::to_string(pair.ramp_end),
             "is later than the end of the run, so the overlap would never be there in full",
             "give a time up to 'Load stepping/End time', which is " +
               dealii::Patterns::Tools::to_string(scene.load_stepping.end_time)},
            {pair.has_pretension() && scene.time_integration.dynamic(),
             section,
             pair.pretension_force.empty() ? "Pretension shortening" : "Pretension force",
             pair.pretension_force + pair.pretension_shortening,
             "is for static runs, but 'Time integration/Scheme' is '" +
               scene.time_integration.scheme.word() + "'",
             "set the scheme to 'static'"},
            {pair.has_pretension() && scene.refinement.changes_mesh(),
             section,
             pair.pretension_force.empty() ? "Pretension shortening" : "Pretension force",
             pair.pretension_force + pair.pretension_shortening,
             "does not go over to a mesh that changes",
             "set 'Refinement/Estimator' to 'none', or 'Cycles' and 'Cycles per step' to 0"},
            {!pair.pretension_until.empty() && std::none_of(scene.load_stepping.phases.begin(),
                                                            scene.load_stepping.phases.end(),
                                                            [&pair](const LoadPhase &phase) {
                                                              return phase.name ==
                                                                     pair.pretension_until;
                                                            }),
             section,
             "Pretension until",
             pair.pretension_until,
             "is no phase of the run",
             "name one of 'Load stepping/Phases'"},
            {pair.tied() && pair.sliding == ContactPairParameters::Sliding::finite,
             section,
             "Sliding",
             pair.sliding.word(),
             "a tied pair cannot slide",
             "remove 'Sliding' or set it to 'small'"},
            {pair.of_one_body() &&
               scene.refinement.estimator == RefinementParameters::Estimator::contact_force,
             "Refinement",
             "Estimator",
             scene.refinement.estimator.word(),
             "estimates no error of contact pair '" + pair.name + "', in which '" +
               pair.slave_body + "' touches itself",
             "set it to 'none', and take a finer mesh"},
            {pair.of_one_body() && scene.refinement.changes_mesh(),
             "Refinement",
             "Estimator",
             scene.refinement.estimator.word(),
             "does not go with contact pair '" + pair.name + "', in which '" + pair.slave_body +
               "' touches itself: forces on refined meshes are off",
             "set it to 'none', and take a finer mesh"},
            {pair.master_normal == MasterNormal::smoothed && scene.discretisation.degree != 1,
             section,
             "Master normal",
             pair.master_normal.word(),
             "only faces of degree 1 can be smoothed; those of degree 2 are curved",
             "set 'Master normal = averaged' or 'Discretisation/Degree = 1'"}};
  }


  std::vector<CombinationRule>
  ball_rules(const Scene &scene, const ContactPairParameters &pair)
  {
    const std::string &name    = pair.pairing.name;
    const bool         balls   = (name == "pinball" || name == "splitting pinball");
    const std::string  section = pair.section(), but = "'Pairing' is '" + name + "'";
    return {{balls && !scene.time_integration.runs_in_cycles(),
             section,
             "Pairing",
             name,
             "is for explicit dynamics, but 'Time integration/Scheme' is '" +
               scene.time_integration.scheme.word() + "'",
             "set it to 'averaged', 'pointwise' or 'inside-outside', or the scheme to "
             "'central_differences'"},
            {balls && !pair.obstacle.empty(),
             section,
             "Pairing",
             name,
             "is for balls in cells of two bodies, but the master is an obstacle",
             "remove the key: nodes meet an obstacle at its exact surface"},
            {balls && pair.tied(),
             section,
             "Behaviour",
             pair.behaviour.name,
             "joins slave nodes to the master, but " + but,
             "set 'Pairing = averaged' or 'pointwise'"},
            {balls && pair.sliding == ContactPairParameters::Sliding::small,
             section,
             "Sliding",
             pair.sliding.word(),
             "keeps the partners of slave nodes, but " + but,
             "remove it, or set 'Pairing = averaged' or 'pointwise'"},
            {balls && pair.master_normal == MasterNormal::smoothed,
             section,
             "Master normal",
             pair.master_normal.word(),
             "smooths the faces, and " + but + " sees cells",
             "remove it, or set 'Pairing = pointwise'"}};
  }
} // namespace Touchstone
