// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact_checks.h>
#include <touchstone/contact/points_in_faces.h>
#include <touchstone/drive/carried_bodies.h>
#include <touchstone/drive/driven_bodies.h>
#include <touchstone/drive/driven_turns.h>
#include <touchstone/drive/explicit_step.h>
#include <touchstone/drive/step_problem.h>
#include <touchstone/scene/pair_input.h>
#include <touchstone/solid/bodies.h>
#include <touchstone/solid/conflicting_supports.h>
#include <touchstone/solid/turning_supports.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <set>

// One implicit step (doc/theory.md 5), from the start of the problem to what is found of each
// solution. Newton's iteration is in step_iteration.cc, what is kept of a step in step_history.cc,
// checks of its outcome are in step_checks.cc. All functions are collective.
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
              boundary_conditions.mirrors(),
              boundary_conditions.supported_directions())
    , pretension(scene.pairs, scene.load_stepping, contact)
    , tools(scene.obstacles, scene.time_integration, scene.newton.residual_tolerance, contact)
    , u(solid.zero_vector())
    , committed_u(u)
    , external(u)
    , internal(u)
    , applied(u)
    , unbalanced(u)
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
    integration = TimeIntegration::make(
      scene.time_integration, scene.load_stepping.nominal_step(0.), solid, slaves, committed_u);
    if (const Mass *const mass = integration->moved_mass())
      boundary_conditions.act_on_mass(*mass);
    system = std::make_unique<StepSystem>(
      StepSystem::Parts{scene, solid, boundary_conditions, contact, *integration});
    parts = {integration.get(), &solid, &contact, &pretension, &tools};
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
    check_supports(boundary_conditions, scene.load_stepping.step_ends(), solid.communicator);
    {
      TimerOutput::Scope scope(timer, "search");
      // Contact starts in the initial displacement and is committed at once: the first step may
      // fail and has to be able to return here.
      contact.update(u, 0.);
      contact.commit();
      remember_contact();
      tools.start();
    }
    // In statics a rigid motion without support has no equilibrium; in dynamics inertia resists it.
    if (!integration->dynamic())
      system->check_bodies_without_support(u);
    else
      {
        // The state of the material at time 0 is committed, too: the first step needs the
        // temperature and stress that it begins with.
        solid.internal_force(u, internal);
        solid.commit();
        system->prescribe(0., u);
        // The velocity and acceleration that a support prescribes are difference quotients of its
        // displacement over a time that is short compared with a step. Components across the
        // prescribed direction keep what they have.
        const auto now      = boundary_conditions.displacements(0.);
        const auto set_rate = [&](Vector &rate, const auto &of_support) {
          for (std::size_t k = 0; k < now.size(); ++k)
            {
              double miss = of_support(k);
              for (unsigned int d = 0; d < dim; ++d)
                miss -= now[k].direction[d] * rate(dim * now[k].node + d);
              for (unsigned int d = 0; d < dim; ++d)
                rate(dim * now[k].node + d) += miss * now[k].direction[d];
            }
          rate.compress(VectorOperation::add);
        };
        const double step         = scene.load_stepping.nominal_step(0.);
        const auto   set_velocity = [&](Vector &velocity) {
          const double instant = 1e-6 * step;
          const auto   soon    = boundary_conditions.displacements(instant);
          set_rate(velocity,
                   [&](const std::size_t k) { return (soon[k].value - now[k].value) / instant; });
        };
        const auto set_acceleration = [&](Vector &acceleration) {
          const double instant = 1e-3 * step;
          const auto   soon    = boundary_conditions.displacements(instant),
                     later     = boundary_conditions.displacements(2. * instant);
          set_rate(acceleration, [&](const std::size_t k) {
            return (later[k].value - 2. * soon[k].value + now[k].value) / (instant * instant);
          });
        };
        integration->start(external, internal, {set_velocity, set_acceleration, [&](Vector &force) {
                                                  system->remove_supported(force);
                                                }});
      }
    return start_report(contact);
  }



  void
  StepProblem::begin_step(const double t)
  {
    time = t;
    contact.begin_step(committed_u, committed_time);
    withdraw_points(contact);
    contact.enforcement().begin_step();
    pretension.begin_step(t);
    tools.begin_step(t);
    integration->begin_step(time, u);
    guessed = false;
    if (integration->follows_supports())
      {
        guessed                 = move_driven_bodies(boundary_conditions, contact, solid, time, u);
        const StepOfBodies step = {
          boundary_conditions, contact, solid, system->unsupported_bodies(), committed_u, time};
        guessed = carry_bodies(step, u) || guessed;
      }
    // Only the first residual of the step, at the first guess of its end, estimates when the first
    // gap closes: later iterates already obey contact.
    touch_unknown = integration->dynamic();
    exchanged_rows.clear();
    exchanges = exchanged_since = 0;
    forcing_term.begin_step();
    system->begin_step();
    strayed.begin_step(committed_time);
    boundary_conditions.external_force(time, u, external);
    // Last: the functions above use the committed state of the material.
    solid.begin_step(time - committed_time, time);
  }



  unsigned int
  StepProblem::solve(const double            t,
                     const NewtonParameters &parameters,
                     const Newton::Observer &observer)
  {
    begin_step(t);
    const Newton newton(parameters);
    const Vector first_guess(u);
    unsigned int n_iterations = 0;
    // Each round adds points inside slave faces where the one before has missed contact, leaves
    // rows to others where pairs have come to meet, and lets nodes go that have left their edges;
    // what is missed after the last is told of by findings().
    constexpr unsigned int most_rounds = 10;
    for (unsigned int round = 0; round <= most_rounds; ++round)
      {
        // A guess may balance what no system of equations has been made for: rows that conflict
        // with supports are found in it.
        n_iterations += solve_with_springs(newton, observer, /*least=*/guessed ? 1 : 0);
        // A correction may be smaller than the tolerance of gaps: without a solve the forces would
        // stay as they were, and the next correction would be made for them once more.
        while (pretension.correct(solid.ghosted(u)) || tools.correct(solid.ghosted(u)))
          n_iterations += newton.solve(*this, observer, /*least=*/1);
        n_iterations += take_out_free_motion(newton, observer);
        forget_increment();
        if (round == most_rounds)
          break;
        const bool formed = contact.find_formed(u), left = contact.leave_edges(),
                   points = !left && place_points(contact);
        if (!formed && !left && !points)
          break;
        // The state without these points tells where they are and no more: bodies have sprung back
        // in it, or overlap deeply, and what a point carried when the step began is far away.
        u = first_guess;
        contact.begin_again(committed_u, committed_time);
        strayed.begin_round();
      }
    return n_iterations;
  }



  double
  StepProblem::end_of_step(const double t) const
  {
    const auto turns = [this](const double from, const double to) {
      return turns_of_supports(solid, boundary_conditions, from, to);
    };
    return end_of_turn(contact, turns, committed_time, t);
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



  void
  StepProblem::prepare(const double t)
  {
    begin_step(t);
    residual(0);
    linearize();
  }



  std::string
  StepProblem::held_by_contact() const
  {
    return system->unsupported();
  }



  StepState
  StepProblem::state() const
  {
    // What the supports must add for the nodes to be in balance.
    const auto needed = [this]() {
      Vector support(unbalanced);
      support *= -1.;
      return support;
    };
    return {u,
            contact,
            *integration,
            solid,
            {linear_counts(), assemblies, n_searches()},
            pretension.results(),
            tools.results(),
            [this, needed]() { return boundary_conditions.reactions(needed()); },
            [this, needed]() { return boundary_conditions.nodal_reactions(needed()); }};
  }



  std::string
  StepProblem::advice() const
  {
    return scene.pairs.empty()
             ? "Try more load steps, or a finer mesh."
             : "Try more load steps, a finer mesh at the contact, or another enforcement.";
  }



  StepFindings
  StepProblem::findings() const
  {
    StepFindings          result;
    const PointsInContact points = points_in_contact(contact);
    result.remarks               = remarks(points.n);
    result.warnings              = check_loose_bodies();
    for (const std::vector<std::string> &more : {points.warnings, check_springs()})
      result.warnings.insert(result.warnings.end(), more.begin(), more.end());
    check_contact();
    result.missed = MissedPairs::shallow(missed_contact(contact));
    return result;
  }



  StepDifficulty
  StepProblem::difficulty() const
  {
    std::string suspicion;
    if (!system->stabilised().empty())
      suspicion =
        "; held by contact alone, perhaps against no resistance: " + system->stabilised() +
        motion_of_loose_bodies() + pairs_without_partner();
    if (!system->unsupported_parts().empty())
      suspicion += "; not connected with the rest of the body and held by contact alone: " +
                   system->unsupported_parts() + "; make each such part a body of its own";
    if (!solid.linear())
      if (const std::string place = unstable_place(); !place.empty())
        suspicion += "; the material of " + place +
                     " is compressed so far that by its 'Law' it resists no longer";
    if (const std::string pairs = pairs_with_points(contact); !pairs.empty())
      suspicion += "; contact of " + pairs +
                   " passes between slave nodes that touch nothing: refine the slave surface";
    suspicion +=
      far_from_origin() + inner_corners() + friction_without_pressure() + stick_of_held_nodes();
    return {worst_place(), suspicion};
  }



  std::unique_ptr<Step>
  Step::make(const Scene &scene, const Forest &forest, Solid &solid, TimerOutput &timer)
  {
    if (scene.time_integration.runs_in_cycles())
      return std::make_unique<ExplicitStep>(scene, forest, solid, timer);
    return std::make_unique<StepProblem>(scene, forest, solid, timer);
  }



  std::string
  StepProblem::remarks(const unsigned int points) const
  {
    std::string  text;
    unsigned int dropped = 0;
    for (const ContactRow &row : contact.rows())
      dropped += (contact.state(row).active() && contact.state(row).dropped());
    dropped = Utilities::MPI::sum(dropped, solid.communicator);
    if (dropped > 0)
      // A remark and no error: what the dropped conditions would determine is determined already.
      // Where that leaves an overlap missed_contact() tells of it.
      text = std::to_string(dropped) +
             " contact row(s) dropped: prescribed displacements or other pairs decide there";
    if (points > 0)
      text += std::string(text.empty() ? "" : "\n") + std::to_string(points) +
              " point(s) inside slave faces carry contact that passes between their nodes";
    if (!system->stabilised().empty())
      text += std::string(text.empty() ? "" : "\n") +
              "held by contact alone, stabilised: " + system->stabilised();
    // Each remark of the solver is reported once.
    for (const std::string &remark : system->linear_solver().take_remarks())
      text += (text.empty() ? "" : "\n") + remark;
    return text;
  }
} // namespace Touchstone
