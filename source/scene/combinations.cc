// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/contact/enforcement/enforcement.h>
#include <touchstone/scene/combinations.h>
#include <touchstone/scene/scene.h>

#include <algorithm>

/**
 * @file
 * Combinations of keys that are refused. Each key is valid by itself here (the check() of its
 * section has passed); these rules find combinations that no single section can see. They are
 * tables rather than code, so that each rule reads as one entry: condition, key, problem, remedy.
 * All are checked before the mesh is made.
 */

namespace Touchstone
{
  namespace
  {
    /** A combination that is refused if @p broken, with the parts of the InputError. */
    struct Rule
    {
      bool        broken;
      std::string section, key, value, problem, remedy;
    };

    std::string
    as_text(const double value)
    {
      return dealii::Patterns::Tools::to_string(value);
    }



    /**
     * Element types but 'full' are for degree 1, and for small or for finite strain, see
     * doc/theory.md 2.1 and 2.2.
     */
    std::vector<Rule>
    element_rules(const Scene &scene, const BodyParameters &body)
    {
      const MaterialParameters &material = body.material;
      const ElementType         type     = body.element();
      // B-bar and incompatible modes modify the small-strain operator; F-bar is their counterpart
      // at finite strain.
      const bool small_only = type == ElementType::b_bar || type == ElementType::incompatible_modes;
      const std::string section = body.section(), name = body.element_type.word(),
                        but_law = ", but 'Material/Law' is '" + material.law.name + "'";
      return {
        {scene.discretisation.degree > 1 && type != ElementType::full,
         section,
         "Element",
         name,
         "is made for degree 1, but 'Discretisation/Degree' is " +
           std::to_string(scene.discretisation.degree),
         "take the element 'automatic' or 'full', or degree 1"},
        {type == ElementType::incompatible_modes && !material.linear() && !material.finite_strain(),
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



    /** Inertia needs densities; initial velocities and damping need inertia. */
    std::vector<Rule>
    inertia_rules(const Scene &scene, const BodyParameters &body)
    {
      const TimeIntegrationParameters &time     = scene.time_integration;
      const MaterialParameters        &material = body.material;
      const std::string                section  = body.section() + "/Material";
      std::vector<Rule>                rules    = {
                          {time.dynamic() && material.density <= 0.,
                           section,
                           "Density",
                           as_text(material.density),
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
        rules.push_back(
          {!time.dynamic() && value > 0., section, key, as_text(value), nothing, remedy});
      return rules;
    }



    /** Explicit dynamics (doc/explicit.md, section 1), and what only that has. */
    std::vector<Rule>
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

    std::vector<Rule>
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
               as_text(body.material.rayleigh_stiffness),
               "would shorten the stable step of explicit dynamics beyond use",
               "take 'Rayleigh mass', or 'Time integration/Linear bulk viscosity'"}};
    }



    /**
     * Tied pairs do not slide, and Gregory patches (doc/theory.md 4, "Smoothing") exist for
     * bilinear faces only.
     */
    std::vector<Rule>
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
               as_text(pair.ramp_end),
               "means nothing while 'Initial overlap' is '" + pair.initial_overlap.word() + "'",
               "remove it, or set 'Initial overlap' to 'ramp'"},
              {pair.ramp_end > scene.load_stepping.end_time,
               section,
               "Overlap end time",
               as_text(pair.ramp_end),
               "is later than the end of the run, so the overlap would never be there in full",
               "give a time up to 'Load stepping/End time', which is " +
                 as_text(scene.load_stepping.end_time)},
              {pair.has_pretension() && scene.time_integration.dynamic(),
               section,
               pair.pretension_force.empty() ? "Pretension shortening" : "Pretension force",
               pair.pretension_force + pair.pretension_shortening,
               "is for static runs, but 'Time integration/Scheme' is '" +
                 scene.time_integration.scheme.word() + "'",
               "set the scheme to 'static'"},
              {pair.has_pretension() && scene.refinement.active(),
               section,
               pair.pretension_force.empty() ? "Pretension shortening" : "Pretension force",
               pair.pretension_force + pair.pretension_shortening,
               "does not go over to a mesh that changes",
               "set 'Refinement/Estimator' to 'none'"},
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
              {pair.of_one_body() && scene.refinement.active(),
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



    /** Pairings of cells (doc/theory.md 3.5): their rows have no slave node of their own that could
     * be eliminated or projected to. */
    std::vector<Rule>
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



    /**
     * Mesh, mass, enforcement and linear solver: a partitioner that cannot refine, multipliers for
     * a solver that needs a definite matrix, an unsymmetric tangent for one that needs a symmetric
     * matrix.
     */
    std::vector<Rule>
    method_rules(const Scene &scene)
    {
      using Partitioner                           = DiscretisationParameters::Partitioner;
      const DiscretisationParameters &discretised = scene.discretisation;
      const ContactParameters        &contact     = scene.contact;
      const LinearSolverParameters   &solver      = scene.linear_solver;
      // Asked of the enforcement itself, so that one that is added later is judged by the same
      // rule.
      const auto enforcement = contact.enforcement.make(contact);
      const bool multipliers = enforcement->uses_multipliers();
      const bool in_cycles   = scene.time_integration.runs_in_cycles();
      // Multipliers that are updated by twice the stiffness m / h^2 or more move away from those
      // that close the gaps.
      const ImpulseRule *const rule     = enforcement->impulse_rule();
      const bool               diverges = in_cycles && rule != nullptr &&
                            rule->method == ImpulseRule::Method::augmentation && rule->factor >= 2.;
      return {{!in_cycles && !scene.general.empty(),
               "",
               "Contact pairs",
               "all",
               "is for explicit dynamics, but 'Time integration/Scheme' is '" +
                 scene.time_integration.scheme.word() + "'",
               "name a pair with a slave and a master body, or set the scheme to "
               "'central_differences'"},
              {!scene.general.empty() && rule != nullptr &&
                 rule->method != ImpulseRule::Method::projection,
               "Contact",
               "Enforcement",
               contact.enforcement.name,
               "leaves surfaces that cross, which general contact does not allow",
               "set it to 'automatic', or give each contact pair a master body or an obstacle"},
              {in_cycles ? rule == nullptr : !enforcement->solves_systems(),
               "Contact",
               "Enforcement",
               contact.enforcement.name,
               std::string(in_cycles ? "solves systems of equations, but"
                                     : "is for explicit dynamics, but") +
                 " 'Time integration/Scheme' is '" + scene.time_integration.scheme.word() + "'",
               "set it to 'automatic', which goes with all schemes"},
              {diverges,
               "Contact",
               "Penalty factor",
               as_text(contact.penalty_factor),
               "lets the multipliers of 'augmented lagrange' diverge in explicit dynamics",
               "take less than 2; 1 is the automatic choice"},
              {scene.refinement.active() && discretised.partitioner != Partitioner::p4est &&
                 discretised.partitioner != Partitioner::automatic,
               "Discretisation",
               "Partitioner",
               discretised.partitioner.word(),
               "its mesh cannot be refined during the run",
               "set it to 'automatic', or 'Estimator' in section 'Refinement' to 'none'."},
              {scene.time_integration.mass == MassKind::dispersion_corrected &&
                 discretised.degree != 1,
               "Time integration",
               "Mass",
               scene.time_integration.mass.word(),
               "is made for degree 1",
               "set it to 'consistent', or 'Discretisation/Degree' to 1"},
              {multipliers && !solver.takes_multipliers(),
               "Contact",
               "Enforcement",
               contact.enforcement.name,
               "multipliers make the system indefinite, which '" + solver.type + "' cannot solve",
               "set 'Contact/Enforcement = elimination' or 'Linear solver/Type = MUMPS'"},
              {contact.linearisation == ContactParameters::Linearisation::consistent &&
                 solver.symmetric_only(),
               "Contact",
               "Linearisation",
               contact.linearisation.word(),
               "makes the system unsymmetric, which '" + solver.type + "' cannot solve",
               "set it to 'automatic' or 'frozen', or 'Linear solver/Type' to 'MUMPS' or "
               "'Belos GMRES'"}};
    }



    /** Throw the first broken rule. */
    void
    obey(const std::vector<Rule> &rules)
    {
      for (const Rule &rule : rules)
        if (rule.broken)
          throw InputError(rule.section, rule.key, rule.value, rule.problem, rule.remedy);
    }
  } // namespace



  void
  check_combinations(const Scene &scene)
  {
    for (const BodyParameters &body : scene.bodies)
      obey(element_rules(scene, body));
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
