// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/formula.h>
#include <touchstone/base/input_error.h>
#include <touchstone/base/non_convergence.h>
#include <touchstone/contact/contact_checks.h>
#include <touchstone/drive/explicit_step.h>
#include <touchstone/scene/pair_input.h>
#include <touchstone/solid/conflicting_supports.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

// An output interval of explicit dynamics (doc/explicit.md, section 1). Its cycles are in
// explicit_cycle.cc, their lengths in explicit_plan.cc, what is kept of them in
// explicit_history.cc.
namespace Touchstone
{
  using namespace dealii;

  ExplicitStep::ExplicitStep(const Scene  &scene,
                             const Forest &forest,
                             Solid        &solid,
                             TimerOutput  &timer)
    : scene(scene)
    , solid(solid)
    , timer(timer)
    , parameters(scene.time_integration.cycles)
    , boundary_conditions(forest, solid)
    , contact(pair_inputs(scene, forest, solid),
              scene.contact,
              solid,
              boundary_conditions.mirrors())
    , map(solid)
    , supports(boundary_conditions, map)
    , loads(boundary_conditions, solid, map)
    , cells(map, scene.bodies, parameters)
    , displacement(solid.zero_vector())
    , velocity(displacement)
  {
    if (solid.has_hanging_nodes())
      throw InputError("Time integration",
                       "Scheme",
                       scene.time_integration.scheme.word(),
                       "is for meshes without hanging nodes",
                       "take a mesh whose cells meet at whole faces, or another scheme");
    if (parameters.stable_step == ExplicitParameters::StableStepBound::power_iteration &&
        solid.has_history())
      throw InputError("Time integration",
                       "Stable step",
                       parameters.stable_step.word(),
                       "is for laws without history: unloading is stiffer than what it could find",
                       "set it to 'cells'");
    if (scene.has_contact())
      {
        std::unique_ptr<GeneralContact> general;
        if (!scene.general.empty())
          general = std::make_unique<GeneralContact>(scene.general.front(),
                                                     general_contact_input(scene, forest),
                                                     solid,
                                                     map);
        impulses = std::make_unique<ImpulseContact>(
          contact, scene.contact, map, scene.bodies, scene.obstacles, std::move(general));
      }
    for (NodeField *field : {&now.u, &now.v, &now.internal, &now.viscous})
      field->resize(map.n_local());
    now.support.resize(supports.nodes().size());
    support_impulse.resize(supports.nodes().size());
    if (!loads.empty())
      now.external.resize(map.n_local());
    for (const BodyParameters &body : scene.bodies)
      if (body.material.rayleigh_mass > 0.)
        damping.resize(map.n_owned());
    for (unsigned int n = 0; n < damping.size(); ++n)
      damping[n] = scene.bodies[map.body(n)].material.rayleigh_mass;
    // Work of the kinds that there are.
    if (!loads.empty() || !supports.nodes().empty())
      work.external.resize(map.n_owned());
    if (parameters.linear_viscosity > 0. || parameters.quadratic_viscosity > 0.)
      work.viscous.resize(map.n_owned());
    work.damping.resize(damping.size());
    if (impulses || !damping.empty() || !supports.nodes().empty())
      v_before.resize(map.n_local());
    solid.keep_history_in(&cells);
  }



  ExplicitStep::~ExplicitStep()
  {
    solid.keep_history_in(nullptr);
  }



  void
  ExplicitStep::set_from_formulas(const std::string         &key,
                                  std::array<std::string, 3> BodyParameters::*const formulas,
                                  NodeField                                        &field) const
  {
    Formulas all;
    for (unsigned int b = 0; b < scene.bodies.size(); ++b)
      for (unsigned int d = 0; d < dim; ++d)
        if (const auto function = all.add(scene.bodies[b].section(),
                                          key + std::string(1, "xyz"[d]),
                                          (scene.bodies[b].*formulas)[d]))
          for (unsigned int n = 0; n < map.n_owned(); ++n)
            if (map.body(n) == b)
              field[n][d] = function->value(Point<dim>(map.positions()[n]), 0.);
    all.check(solid.communicator);
  }



  void
  ExplicitStep::set_initial_values()
  {
    set_from_formulas("Initial displacement ", &BodyParameters::initial_displacement, now.u);
    set_from_formulas("Initial velocity ", &BodyParameters::initial_velocity, now.v);
    // A support prescribes the difference quotient of its displacement over a time that is short
    // beside the interval; other components keep their initial velocity.
    const double instant  = 1e-6 * scene.load_stepping.nominal_step(0.);
    NodeField    at_start = now.u;
    supports.set_displacements(0., at_start);
    supports.set_velocities(instant, instant, at_start, now.v);
    now.u = at_start;
    supports.check();
    map.update_ghosts(now.u);
    map.update_ghosts(now.v);
  }



  std::vector<std::string>
  ExplicitStep::names_of_bodies() const
  {
    std::vector<std::string> names;
    for (const BodyParameters &body : scene.bodies)
      names.push_back(body.name);
    return names;
  }



  std::vector<std::string>
  ExplicitStep::start()
  {
    set_initial_values();
    check_supports(boundary_conditions, scene.load_stepping.step_ends(), solid.communicator);
    std::vector<std::string> lines;
    if (parameters.mass_scaling_step > 0.)
      {
        const auto [mass, added] = cells.scale_masses(now.u);
        char text[120];
        std::snprintf(
          text, sizeof(text), "mass scaling adds %.4g to the mass of %.4g", added, mass);
        lines.push_back(text);
      }
    if (impulses)
      set_mobilities(0.);
    const double interval = scene.load_stepping.nominal_step(0.);
    unsigned int n        = 1;
    try
      {
        n          = plan_cycles(interval).cycles;
        now.length = interval / n;
        evaluate_forces(0.);
      }
    catch (const ExplicitFailure &failure)
      {
        throw InputError("Time integration",
                         "Scheme",
                         scene.time_integration.scheme.word(),
                         std::string("cannot begin with the initial displacements and loads: ") +
                           failure.what(),
                         "take smaller initial displacements, or another mesh or law");
      }
    boundary_conditions.all_formulas().check(solid.communicator);
    if (impulses && impulses->general_contact() != nullptr)
      impulses->general_contact()->check_start(now.u, names_of_bodies());
    // The velocity half a cycle before time 0, so that all cycles are alike.
    const NodeField at_start = now.v;
    for (unsigned int i = 0; i < map.n_owned(); ++i)
      {
        // v_0 = (1 - a h/2) v_{-1/2}: the distance in which damping alone stops a body is exact.
        const double half = damping.empty() ? 0. : 0.5 * damping[i] * now.length;
        now.v[i] += supports.free_part(i,
                                       1. / (1. - half) *
                                         (half * at_start[i] -
                                          0.5 * now.length / cells.masses()[i] * now.force(i)));
      }
    map.update_ghosts(now.v);
    if (impulses)
      {
        impulses->tool_nodes().kick(0., -0.5 * now.length);
        impulses->project_before(now.u, at_start, now.v, 0., now.length);
        map.update_ghosts(now.v);
      }
    keep();
    cells.commit();
    if (impulses)
      impulses->tool_nodes().commit();
    // Initial displacements may have made cells yield, or have hourglass modes: that is there, too.
    committed         = energies();
    committed.initial = committed.present() + committed.plastic + committed.hourglass;
    committed.update_largest();
    contact.update(displacement, 0.);
    contact.commit();
    char text[200];
    std::snprintf(text, sizeof(text), "stable step %.4g, of ", counts.stable_step);
    lines.push_back(text + counts.cell + ": about " +
                    std::to_string(std::llround(n * scene.load_stepping.end_time / interval)) +
                    " cycles");
    return lines;
  }



  unsigned int
  ExplicitStep::solve(const double t, const NewtonParameters &, const Newton::Observer &)
  {
    TimerOutput::Scope scope(timer, "assembly");
    const auto         began = std::chrono::steady_clock::now();
    counts                   = CycleCounts();
    found                    = StepFindings();
    if (impulses)
      impulses->begin_interval();
    std::fill(support_impulse.begin(), support_impulse.end(), Tensor<1, dim>());
    const double start  = now.time;
    double       length = 0.;
    for (unsigned int left = 0, done = 0, next = 0; now.time < t; ++done, --left)
      {
        if (done == next)
          {
            const Plan plan = plan_cycles(t);
            left            = plan.cycles;
            next            = done + plan.next;
            length          = (t - now.time) / left;
          }
        if (done == 0)
          counts.smallest_step = length;
        cycle(length);
        if (left == 1)
          now.time = t;
      }
    solid.set_time(t); // of the stresses that results show
    boundary_conditions.all_formulas().check(solid.communicator);
    // What results show of supports is their mean force over the interval, as of contact.
    for (std::size_t k = 0; k < now.support.size(); ++k)
      now.support[k] = support_impulse[k] / (t - start);
    if (impulses)
      {
        impulses->end_interval(now.u, t);
        impulses->tool_nodes().end_interval(t);
        counts.contact = impulses->work();
      }
    judge();
    if (impulses)
      judge_directions(t - start);
    counts.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return 0;
  }
} // namespace Touchstone
