// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/enforcement/enforcement.h>
#include <touchstone/scene/combination_rules.h>
#include <touchstone/scene/scene.h>

#include <deal.II/base/patterns.h>

namespace Touchstone
{
  std::vector<CombinationRule>
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
    return {
      {!in_cycles && !scene.general.empty(),
       "",
       "Contact pairs",
       "all",
       "is for explicit dynamics, but 'Time integration/Scheme' is '" +
         scene.time_integration.scheme.word() + "'",
       "name a pair with a slave and a master body, or set the scheme to "
       "'central_differences'"},
      {!scene.general.empty() && rule != nullptr && rule->method != ImpulseRule::Method::projection,
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
       dealii::Patterns::Tools::to_string(contact.penalty_factor),
       "lets the multipliers of 'augmented lagrange' diverge in explicit dynamics",
       "take less than 2; 1 is the automatic choice"},
      {scene.refinement.changes_mesh() && discretised.partitioner != Partitioner::p4est &&
         discretised.partitioner != Partitioner::automatic,
       "Discretisation",
       "Partitioner",
       discretised.partitioner.word(),
       "its mesh cannot be refined during the run",
       "set it to 'automatic', or 'Estimator' in section 'Refinement' to 'none'."},
      {scene.time_integration.mass == MassKind::dispersion_corrected && discretised.degree != 1,
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
} // namespace Touchstone
