// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/base/non_convergence.h>
#include <touchstone/contact/contact_checks.h>
#include <touchstone/contact/enforcement/row_terms.h>
#include <touchstone/drive/step_problem.h>
#include <touchstone/scene/pair_input.h>
#include <touchstone/solid/bodies.h>

#include <algorithm>
#include <cmath>
#include <set>

// One implicit step as Newton's method sees it (doc/theory.md 5). In each iteration residual()
// updates the contact geometry, the forces and the active set, linearize() makes the linear system
// with all conditions (StepSystem), solve() solves it and update() applies the increment. What is
// kept of a step is in step_history.cc, checks of its outcome are in step_checks.cc. All functions
// are collective.
namespace Touchstone
{
  using namespace dealii;

  StepProblem::StepProblem(const Scene  &scene,
                           const Forest &forest,
                           Solid        &solid,
                           TimerOutput  &timer)
    : scene(scene)
    , solid(solid)
    , timer(timer)
    , boundary_conditions(forest, solid)
    , contact(pair_inputs(scene, forest, solid),
              scene.contact,
              solid,
              boundary_conditions.mirrors())
    , u(solid.owned, solid.communicator)
    , committed_u(u)
    , external(u)
    , internal(u)
    , applied(u)
    , unbalanced(u)
    , increment(u)
    , solved_increment(u)
    , before_increment(u)
    , forcing_term(scene.linear_solver.tolerance,
                   scene.newton.residual_tolerance,
                   scene.has_friction())
  {
    {
      TimerOutput::Scope scope(timer, "assembly");
      solid.assemble();
      ++assemblies;
    }
    // Slave nodes whose contact may open and close: some schemes move their mass to neighbours, so
    // that no momentum is concentrated in the contact surface. Tied nodes never do.
    std::set<Index> slaves;
    for (const ContactRow &row : contact.rows())
      if (!row.tied)
        slaves.insert(dim * row.slave);
    integration = TimeIntegration::make(scene.time_integration,
                                        scene.load_stepping.end_time / scene.load_stepping.steps,
                                        solid,
                                        slaves,
                                        committed_u);
    system      = std::make_unique<StepSystem>(
      StepSystem::Parts{scene, solid, boundary_conditions, contact, *integration});
    parts = {integration.get(), &solid, &contact};
    // Two lengths: of the largest coordinate, which sets the round-off of positions; and of the box
    // around all bodies, beyond which no increment makes sense.
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        extent = std::max(extent, cell->center().norm());
    extent                 = Utilities::MPI::max(extent, solid.communicator);
    const auto       boxes = body_boxes(solid);
    BoundingBox<dim> all(boxes.front());
    for (const auto &box : boxes)
      all.merge_with(box);
    diameter = all.get_boundary_points().first.distance(all.get_boundary_points().second);
  }



  std::vector<std::string>
  StepProblem::start()
  {
    u = committed_u = integration->initial_displacement();
    // Formulas without a finite value at time 0 are input errors and reported before the run.
    boundary_conditions.external_force(0., u, external);
    boundary_conditions.displacements(0.);
    {
      TimerOutput::Scope scope(timer, "search");
      // Contact starts in the initial displacement and is committed at once: the first step may
      // fail and has to be able to return here.
      contact.update(u, 0.);
      contact.commit();
      remember_contact();
    }
    // In statics a rigid motion without support has no equilibrium; in dynamics inertia resists it.
    if (!integration->dynamic())
      system->check_bodies_without_support(u);
    else
      {
        solid.internal_force(u, internal);
        system->prescribe(0., u);
        // The velocity that a support prescribes is the difference quotient of its displacement
        // over a time that is short compared with a step. Components across the prescribed
        // direction keep their initial velocity.
        const double instant  = 1e-6 * scene.load_stepping.end_time / scene.load_stepping.steps;
        const auto   set_rate = [&](Vector &velocity) {
          const auto now  = boundary_conditions.displacements(0.),
                     soon = boundary_conditions.displacements(instant);
          for (std::size_t k = 0; k < now.size(); ++k)
            {
              double miss = (soon[k].value - now[k].value) / instant;
              for (unsigned int d = 0; d < dim; ++d)
                miss -= now[k].direction[d] * velocity(dim * now[k].node + d);
              for (unsigned int d = 0; d < dim; ++d)
                velocity(dim * now[k].node + d) += miss * now[k].direction[d];
            }
          velocity.compress(VectorOperation::add);
        };
        integration->start(external, internal, {set_rate, [&](Vector &force) {
                                                  system->remove_supported(force);
                                                }});
      }
    return start_report(contact);
  }



  void
  StepProblem::begin_step(const double t)
  {
    time = t;
    contact.enforcement().begin_step();
    integration->begin_step(time, u);
    // Only the first residual of the step, at the first guess of its end, estimates when the first
    // gap closes: later iterates already obey contact.
    touch_unknown = integration->dynamic();
    forcing_term.begin_step();
    system->begin_step();
    boundary_conditions.external_force(time, u, external);
    // Last: the functions above use the committed state of the material.
    solid.begin_step(time - committed_time);
  }



  unsigned int
  StepProblem::solve(const double            t,
                     const NewtonParameters &parameters,
                     const Newton::Observer &observer)
  {
    begin_step(t);
    return Newton(parameters).solve(*this, observer);
  }



  LinearSolverCounts
  StepProblem::linear_counts() const
  {
    LinearSolverCounts        sum = earlier;
    const LinearSolverCounts &now = system->linear_solver().counts();
    sum.solves += now.solves;
    sum.iterations += now.iterations;
    sum.factorisations += now.factorisations;
    sum.preconditioner_setups += now.preconditioner_setups;
    return sum;
  }



  // The order is fixed: geometry at u, forces of the bodies, forces of contact from these, the
  // residual with both, and last the active set, which is judged by the contact forces.
  NewtonState
  StepProblem::residual(const unsigned int damping)
  {
    NewtonState state;
    update_geometry(state);
    Vector without_contact(solid.owned, solid.communicator);
    balance(without_contact);
    contact.enforcement().recover(contact, without_contact, system->conditions());
    judge_balance(without_contact, state);
    update_active_set(damping, state);
    // Uzawa's outer iteration augments forces once they are in balance.
    if (state.changes == 0 && state.prescribed && balanced(state, scene.newton))
      contact.enforcement().balanced(contact);
    forcing_term.update(state, system->linear_solver().symmetric_only() && solid.linear());
    return state;
  }



  void
  StepProblem::update_geometry(NewtonState &state)
  {
    {
      TimerOutput::Scope scope(timer, "search");
      contact.update(u, time);
    }
    // See begin_step().
    if (touch_unknown)
      touch = contact.part_to_touch();
    touch_unknown = false;
    // Prescribed displacements first: they take precedence over contact, and the residual needs
    // their directions. Contact is added in linearize().
    missed = system->prescribe(time, u);
    // Exact up to round-off after the first full increment; a shortened increment misses a part.
    state.prescribed = missed <= scene.newton.gap_tolerance * system->smallest_cell();
  }



  void
  StepProblem::balance(Vector &without_contact)
  {
    {
      TimerOutput::Scope scope(timer, "assembly");
      solid.internal_force(u, internal);
      if (!boundary_conditions.follower_pressure().empty())
        boundary_conditions.external_force(time, u, external);
    }
    // Time integration weighs the forces at both ends of the step and adds inertia. Forces on
    // hanging nodes count for the nodes that these follow.
    integration->balance(u, external, internal, applied);
    without_contact = applied;
    solid.condense(without_contact);
  }



  void
  StepProblem::judge_balance(const Vector &without_contact, NewtonState &state)
  {
    // Relative residual, equation (13): the scale is the largest of internal, external, contact and
    // inertial forces.
    Vector contact_force(solid.owned, solid.communicator);
    contact.add_forces(contact_force);
    unbalanced = without_contact;
    unbalanced += contact_force;

    // Forces along prescribed directions are reactions of the supports and no residual.
    Vector free(unbalanced);
    system->remove_supported(free);
    const double present = std::max(
      {internal.l2_norm(), external.l2_norm(), contact_force.l2_norm(), integration->inertia()});
    const double round_off =
      solid.round_off(u) + integration->round_off(u) +
      std::sqrt(Utilities::MPI::sum(contact.enforcement().round_off_squared(contact.rows(), extent),
                                    solid.communicator));
    // Where forces vanish, at the end of contact for example, the present forces are round-off and
    // no scale for the residual; then a thousandth of the largest forces of earlier steps is used.
    // The forces of a body in free flight are round-off from the start: force_scale excludes them
    // from these.
    constexpr double small_force = 1e-3, largest_round_off = 1e-6;
    force_scale        = largest_round_off * present > round_off ? present : 0.;
    const double scale = std::max(present, small_force * largest_force_scale);
    state.force        = free.l2_norm();
    state.residual     = scale > 0. ? state.force / scale : 0.;
    state.round_off    = scale > 0. ? round_off / scale : 0.;
    // A large round-off is plausible only before the first forces act. Later on it must not hide a
    // residual, so that the allowance is bounded.
    if (largest_force_scale > 0.)
      state.round_off = std::min(state.round_off, largest_round_off);
  }



  void
  StepProblem::update_active_set(const unsigned int damping, NewtonState &state)
  {
    const ActiveSetUpdate set =
      contact.enforcement().update_active_set(contact, scene.newton.gap_tolerance, damping);
    changed_rows.clear();
    for (const ContactRow *row : set.changed)
      changed_rows.push_back(
        {{row->reference[0], row->reference[1], row->reference[2], double(row->pair)}});
    state.gap       = set.gap;
    state.active    = set.active;
    state.changes   = set.changes;
    state.signature = set.signature;
  }



  void
  StepProblem::linearize()
  {
    TimerOutput::Scope scope(timer, "assembly");
    if (!solid.linear())
      {
        // Linear bodies have a constant stiffness, which was assembled in the constructor
        // (doc/theory.md 2.1).
        solid.assemble(u, system->linear_solver().symmetric_only());
        ++assemblies;
      }
    system->assemble({time, u, applied, unbalanced, forcing_term.tolerance(), forcing_term.slow()});
  }



  int
  StepProblem::solve()
  {
    TimerOutput::Scope scope(timer, "linear solver");
    const int          iterations = system->solve(solved_increment);
    check_increment();
    system->recover(solved_increment);
    return iterations;
  }



  void
  StepProblem::update()
  {
    // The strain energy is not defined for det F <= 0, so the increment is halved until all cells
    // are admissible (doc/theory.md 2.2). The multipliers belong to the end of the full increment
    // and are not scaled.
    admissible_part = 1.;
    increment       = solved_increment;
    Vector trial(u);
    trial += increment;
    for (unsigned int halvings = 0; !solid.admissible(trial); ++halvings)
      {
        // The load stepping then cuts the step.
        if (halvings == 6)
          throw InvertedCells("a cell turns inside out (det F <= 0), even with 1/64 of a Newton "
                              "increment: " +
                              inverted_place(trial));
        increment *= 0.5;
        admissible_part *= 0.5;
        trial = u;
        trial += increment;
      }
    before_increment = u;
    u                = trial;
    contact.enforcement().update(contact,
                                 scene.newton.line_search != NewtonParameters::LineSearch::none);
  }



  void
  StepProblem::shorten(const double fraction)
  {
    u = before_increment;
    u.add(fraction, increment);
    contact.enforcement().shorten(contact,
                                  fraction < 1. ? fraction * admissible_part
                                                : 1.); // the full increment, as in update()
  }



  void
  StepProblem::prepare(const double t)
  {
    begin_step(t);
    residual(0);
    linearize();
  }



  StepState
  StepProblem::state() const
  {
    return {u, contact, *integration, solid, {linear_counts(), assemblies, n_searches()}, [this]() {
              // What the supports must add for the nodes to be in balance.
              Vector support(unbalanced);
              support *= -1.;
              return boundary_conditions.reactions(support);
            }};
  }



  StepFindings
  StepProblem::findings() const
  {
    StepFindings result;
    result.remarks  = remarks();
    result.warnings = check_loose_bodies();
    check_contact();
    return result;
  }



  StepDifficulty
  StepProblem::difficulty() const
  {
    std::string suspicion;
    if (!system->stabilised().empty())
      suspicion = "; held by contact alone, perhaps against no resistance: " + system->stabilised();
    if (!solid.linear())
      if (const std::string place = unstable_place(); !place.empty())
        suspicion += "; the material of " + place +
                     " is compressed so far that by its 'Law' it resists no longer";
    return {worst_place(), suspicion};
  }



  std::unique_ptr<Step>
  Step::make(const Scene &scene, const Forest &forest, Solid &solid, TimerOutput &timer)
  {
    return std::make_unique<StepProblem>(scene, forest, solid, timer);
  }



  std::string
  StepProblem::remarks() const
  {
    std::string  text;
    unsigned int dropped = 0;
    for (const ContactRow &row : contact.rows())
      dropped += (contact.state(row).active() && contact.state(row).dropped());
    dropped = Utilities::MPI::sum(dropped, solid.communicator);
    if (dropped > 0)
      // A remark and no error: what the dropped conditions would determine is determined already.
      text = std::to_string(dropped) +
             " contact row(s) dropped: prescribed displacements or other pairs decide there";
    if (!system->stabilised().empty())
      text += std::string(text.empty() ? "" : "\n") +
              "held by contact alone, stabilised: " + system->stabilised();
    // Each remark of the solver is reported once.
    for (const std::string &remark : system->linear_solver().take_remarks())
      text += (text.empty() ? "" : "\n") + remark;
    return text;
  }
} // namespace Touchstone
