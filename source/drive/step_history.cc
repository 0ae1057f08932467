// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/base/non_convergence.h>
#include <touchstone/drive/step_problem.h>

#include <algorithm>
#include <cmath>

// History of an implicit step: what is kept of a converged one, taken back, carried over to another
// mesh, and written to checkpoints. Each part with history is Stateful and listed once, in `parts`;
// here is what concerns several of them.
namespace Touchstone
{
  using namespace dealii;

  double
  StepProblem::try_commit(const double smallest_part)
  {
    double part = 1.;
    with_forces([&](const StepForces &forces) {
      // The energies are known only with the forces at the end; in dynamics they decide whether the
      // step is short enough. A part below the smallest one is not worth a repetition: the step is
      // then kept as it is.
      const Energies end = integration->end_step(u, forces);
      if (smallest_part <= 1.)
        part = acceptable_part(end);
      if (part < smallest_part)
        part = 1.;
      if (part == 1.)
        keep(forces);
    });
    return part;
  }



  void
  StepProblem::keep(const StepForces &forces)
  {
    if (integration->dynamic())
      contact.keep_impulses(forces.velocity_constraints, time - committed_time, forces.end_weight);
    for (Stateful *part : parts)
      part->commit();
    forcing_term.end_step();
    committed_u         = u;
    committed_time      = time;
    largest_force_scale = std::max(largest_force_scale, force_scale);
    remember_contact();
    new_mesh        = false;
    without_springs = false;
    springs.detach();
  }



  void
  StepProblem::with_forces(const std::function<void(const StepForces &)> &use)
  {
    // Statics has no energy balance and needs none of these forces.
    if (!integration->dynamic())
      return use(StepForces());
    Vector normal(solid.zero_vector()), tangential(normal), support(unbalanced);
    contact.add_forces(normal, ForcePart::normal);
    contact.add_forces(tangential, ForcePart::tangential);
    // What the supports add is what is missing to the balance of the nodes.
    support *= -1.;
    const auto                      coefficients = scene.time_integration.coefficients();
    const double                    end_weight   = coefficients.gamma + coefficients.alpha_m;
    std::vector<VelocityConstraint> constraints;
    // Impacts without rebound change velocities, and need the conditions of the nodes in contact.
    const bool plastic = scene.time_integration.plastic_impacts();
    if (plastic && time > committed_time)
      constraints =
        velocity_constraints(contact, system->conditions(), time, time - committed_time);
    use({end_weight,
         &external,
         &internal,
         &normal,
         &tangential,
         &support,
         plastic ? &constraints : nullptr,
         [this](Vector &force) { system->remove_supported(force); },
         contact.work_of_obstacles(ForcePart::normal, end_weight) +
           contact.work_of_overlaps(end_weight, committed_time),
         contact.work_of_obstacles(ForcePart::tangential, end_weight)});
  }



  double
  StepProblem::acceptable_part(const Energies &end) const
  {
    if (!integration->dynamic())
      {
        check_strain_energy(end);
        return 1.;
      }
    const TimeIntegrationParameters &parameters = scene.time_integration;
    // Energy that nothing has supplied comes from the discretisation in time; a shorter step
    // reduces it, hence the exception. No step may take more than half of what the steps before
    // have left of the tolerance: else these would use it up, and no cut could help any more.
    const double before = integration->committed_energies().gain(), here = end.gain() - before,
                 left = parameters.gain_tolerance * end.largest - before;
    if (here > std::max(0.5 * left, 0.))
      throw EnergyGain("energy " + std::to_string(end.gain() / end.largest) +
                       " times the largest so far came from nowhere, " +
                       std::to_string(here / end.largest) +
                       " in this step ('Time integration/Gain tolerance')" +
                       (new_mesh ? "; the mesh has changed in it, and stresses and histories "
                                   "taken over to new points differ from those they come from: "
                                   "refine before the motion begins ('Refinement/Cycles'), or "
                                   "allow for more"
                                 : ""));
    // An impact in the middle of a step: repeat it such that it ends where the first gap closes, as
    // estimated from the first guess.
    const double change = end.contact - integration->committed_energies().contact;
    const bool   impact = parameters.adapts_to_impacts() && touch < 1. - 1e-6 &&
                        std::abs(change) > parameters.impact_tolerance * end.largest;
    return impact ? touch : 1.;
  }



  void
  StepProblem::rollback()
  {
    without_springs = drops_springs();
    springs.detach();
    u = committed_u;
    for (Stateful *part : parts)
      part->rollback();
    // What only a bad first guess was too much for is no reason to iterate in another way.
    if (!guessed)
      forcing_term.end_attempt();
    guessed = false;
  }



  std::string
  StepProblem::next_attempt() const
  {
    if (guessed)
      return "from the displacement that the step begins with";
    if (changes_linearisation())
      return "linearised consistently from the first iteration on";
    if (drops_springs())
      return "without springs";
    return "";
  }



  StepTransfer
  StepProblem::transfer() const
  {
    StepTransfer result;
    // Both states: the committed one as history, the present one as initial guess on the new mesh
    // (doc/theory.md 11, "History"). The order of the fields is the interface to adopt().
    for (const bool of_committed : {true, false})
      {
        result.fields.push_back(of_committed ? committed_u : u);
        for (Vector &field : contact.fields(of_committed))
          result.fields.push_back(std::move(field));
      }
    for (const Vector *field : integration->rates())
      result.fields.push_back(*field);
    result.momenta             = integration->momenta_of_rates();
    result.friction_work       = contact.friction_work();
    result.committed_time      = committed_time;
    result.energies            = integration->committed_energies();
    result.largest_force_scale = largest_force_scale;
    result.counts              = {linear_counts(), assemblies, n_searches()};
    result.tools               = tools.transfer();
    result.strayed             = strayed;
    return result;
  }



  void
  StepProblem::adopt(const StepTransfer &before, const double t)
  {
    earlier             = before.counts.linear;
    earlier_searches    = before.counts.searches;
    largest_force_scale = before.largest_force_scale;
    committed_time      = before.committed_time;
    assemblies += before.counts.assemblies;
    tools.adopt(before.tools);
    strayed = before.strayed;
    // At time 0 the energies are those that the first velocities mean on this mesh.
    if (committed_time > 0.)
      integration->resume(committed_time, before.energies);

    const std::vector<Vector> &fields  = before.fields;
    const std::size_t          n_rates = integration->rates().size();
    // Fields: committed displacement and contact, the same of the present state, and the rates at
    // the end; see transfer().
    const auto middle = fields.begin() + (fields.size() - n_rates) / 2;
    const auto rates  = fields.end() - n_rates;
    // Before the first step there is no history but what start() makes.
    if (committed_time > 0.)
      {
        new_mesh    = true;
        committed_u = u = fields.front();
        // Twice: first the committed state becomes the history, then the present one the initial
        // guess.
        contact.update(u, committed_time);
        contact.adopt({fields.begin() + 1, middle}, true);
        contact.keep_friction_work(before.friction_work);
        remember_contact();
        if (integration->dynamic())
          {
            boundary_conditions.external_force(committed_time, u, external);
            solid.internal_force(u, internal);
            system->prescribe(committed_time, u);
          }
        with_forces([&](const StepForces &forces) {
          integration->adopt({rates, fields.end()}, forces, before.momenta);
        });
      }
    u = *middle;
    tools.continue_at(t, before.tools.guess);
    contact.update(u, t);
    contact.adopt({middle + 1, rates}, false);
  }



  void
  StepProblem::forget()
  {
    // Factors or a multigrid hierarchy of earlier steps change the last digits of later ones; a run
    // that resumes has none.
    system->linear_solver().clear_cache();
    // The round-off of finite-strain forces is estimated with the present tangent, so it must be
    // that of the committed state in both runs.
    if (!solid.linear())
      solid.assemble(u);
  }



  void
  StepProblem::save(ArchiveWriter &archive)
  {
    forget();
    archive.put("committed time", committed_time);
    archive.put_field("displacement", committed_u);
    archive.put("largest force scale", largest_force_scale);
    // Counts go on over a restart, so that the summary is that of the whole run.
    archive.put("linear solver counts", linear_counts());
    archive.put("assemblies", assemblies);
    archive.put("searches", n_searches());
    for (const Stateful *part : parts)
      part->save(archive);
  }



  void
  StepProblem::load(const ArchiveReader &archive)
  {
    time = committed_time = archive.get<double>("committed time");
    u = committed_u = archive.field("displacement");
    for (Stateful *part : parts)
      part->load(archive);
    // Needs the contact that has just been loaded: check_loose_bodies() compares the next step with
    // it.
    remember_contact();
    if (archive.has("largest force scale")) // not in checkpoints of earlier versions
      largest_force_scale = archive.get<double>("largest force scale");
    forget();
    // The work done since the start of this process (search of the initial state) was done by the
    // saved run as well, and must not count twice.
    earlier          = archive.get<LinearSolverCounts>("linear solver counts");
    assemblies       = archive.get<unsigned int>("assemblies");
    earlier_searches = archive.get<unsigned int>("searches") - contact.n_searches();
  }
} // namespace Touchstone
