// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/formula.h>
#include <touchstone/base/input_error.h>
#include <touchstone/base/non_convergence.h>
#include <touchstone/drive/explicit_step.h>
#include <touchstone/explicit/assembled_frequency.h>
#include <touchstone/scene/pair_input.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>

// The cycles of an output interval (doc/explicit.md, section 1). What is kept of them is in
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
    , work(map.n_owned())
    , displacement(solid.owned, solid.communicator)
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
    if (!scene.pairs.empty())
      impulses = std::make_unique<ImpulseContact>(contact, scene.contact, map, scene.bodies);
    for (NodeField *field :
         {&now.u, &now.v, &now.internal, &now.viscous, &now.support, &support_impulse, &v_before})
      field->resize(map.n_local());
    if (!loads.empty())
      now.external.resize(map.n_local());
    for (const BodyParameters &body : scene.bodies)
      if (body.material.rayleigh_mass > 0.)
        damping.resize(map.n_owned());
    for (unsigned int n = 0; n < damping.size(); ++n)
      damping[n] = scene.bodies[map.body(n)].material.rayleigh_mass;
    solid.keep_history_in(&cells);
  }



  ExplicitStep::~ExplicitStep()
  {
    solid.keep_history_in(nullptr);
  }



  void
  ExplicitStep::set_mobilities(const double between)
  {
    mobile_for = between;
    std::vector<SymmetricTensor<2, dim>> mobilities(map.n_owned());
    for (unsigned int i = 0; i < map.n_owned(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const Tensor<1, dim> free = supports.free_part(i, Point<dim>::unit_vector(d));
          for (unsigned int e = d; e < dim; ++e)
            mobilities[i][d][e] = free[e] / damped_mass(i, between);
        }
    impulses->set_mobility(mobilities);
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
    const double instant  = 1e-6 * scene.load_stepping.end_time / scene.load_stepping.steps;
    NodeField    at_start = now.u;
    supports.set_displacements(0., at_start);
    supports.set_velocities(instant, instant, at_start, now.v);
    now.u = at_start;
    supports.check();
    map.update_ghosts(now.u);
    map.update_ghosts(now.v);
  }



  std::vector<std::string>
  ExplicitStep::start()
  {
    set_initial_values();
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
    const double interval = scene.load_stepping.end_time / scene.load_stepping.steps;
    unsigned int n        = 1;
    try
      {
        n          = plan_cycles(interval);
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
    // The velocity half a cycle before time 0, so that all cycles are alike.
    const NodeField at_start = now.v;
    for (unsigned int i = 0; i < map.n_owned(); ++i)
      {
        now.v[i] -= supports.free_part(i, 0.5 * now.length / cells.masses()[i] * now.force(i));
      }
    map.update_ghosts(now.v);
    if (impulses)
      {
        impulses->project_before(now.u, at_start, now.v, 0., now.length);
        map.update_ghosts(now.v);
      }
    kept = now;
    cells.commit();
    committed         = energies();
    committed.initial = committed.present();
    committed.update_largest();
    update_results();
    contact.update(displacement, 0.);
    contact.commit();
    char text[200];
    std::snprintf(text, sizeof(text), "stable step %.4g, of ", counts.stable_step);
    lines.push_back(text + counts.cell + ": about " +
                    std::to_string(std::uint64_t(n) * scene.load_stepping.steps) + " cycles");
    return lines;
  }



  // Contact springs with frequencies up to @p square shorten the stable step of the cells: leapfrog
  // with viscous forces of the velocity half a cycle before is stable where
  //   h^2/4 v.(K + K_c)v + h/2 v.C v <= v.M v .
  // At the step of the cells alone the terms of K and C are 1 together; of which part K is matters
  // little, and with viscosity none is the cautious choice.
  double
  ExplicitStep::with_springs(const double length, const double square) const
  {
    if (square == 0.)
      return length;
    const double q = 0.25 * length * length * square;
    return length * (parameters.viscous() ? (std::sqrt(1. + 4. * q) - 1.) / (2. * q)
                                          : 1. / std::sqrt(1. + q));
  }



  // The step that the mesh as a whole allows, relative to that of its cells by themselves. Within
  // an interval it follows the latter.
  void
  ExplicitStep::find_assembled_step(const double of_cells)
  {
    double size = std::numeric_limits<double>::max();
    for (const NodeMap::Cell &cell : map.cells())
      for (unsigned int axis = 0; axis < dim; ++axis)
        size = std::min(
          size, (map.positions()[cell.nodes[1U << axis]] - map.positions()[cell.nodes[0]]).norm());
    size = Utilities::MPI::min(size, solid.communicator);
    const NodeField at_rest(map.n_local());
    NodeField       viscous(map.n_local());
    const double    square = assembled_square_frequency(
      map,
      cells.masses(),
      now.u,
      [&](NodeField &u, NodeField &force) { cells.evaluate(u, at_rest, 0., force, viscous); },
      size);
    // The bound of the cells is one for the mesh, too.
    assembled_to_cells = std::max(1., 2. / std::sqrt(square) / of_cells);
  }



  unsigned int
  ExplicitStep::plan_cycles(const double t)
  {
    const StableStep stable = cells.stable_step(now.u, now.v);
    counts.stable_step      = stable.length;
    counts.cell             = stable.cell.text(scene.bodies);
    if (parameters.stable_step == ExplicitParameters::StableStepBound::power_iteration)
      {
        if (now.time == kept.time)
          find_assembled_step(stable.length);
        counts.stable_step *= assembled_to_cells;
      }
    if (impulses)
      counts.stable_step = with_springs(counts.stable_step,
                                        impulses->square_frequency(now.u, now.time, stable.length));
    const double cycle = parameters.courant_factor * counts.stable_step;
    // Equal cycles up to the end of the interval: a shorter last one would spoil what is exact for
    // constant steps. What is too long by round-off does not make another cycle.
    const double n = std::ceil((t - now.time) / cycle * (1. - 1e-12));
    // Far beyond what can be run: the step has collapsed.
    constexpr double most = 1e9;
    if (!(n < most))
      {
        char text[80];
        std::snprintf(text,
                      sizeof(text),
                      "the stable step has collapsed to %.3g at ",
                      counts.stable_step);
        throw ExplicitFailure(text + counts.cell +
                              ": a cell has become very small; take a coarser mesh or a harder "
                              "material there, or 'Mass scaling step'");
      }
    return std::max(1., n);
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
    for (unsigned int left = 0, done = 0; now.time < t; ++done, --left)
      {
        if (done % parameters.check_interval == 0)
          {
            left   = plan_cycles(t);
            length = (t - now.time) / left;
          }
        counts.smallest_step = done == 0 ? length : std::min(counts.smallest_step, length);
        ++counts.cycles;
        cycle(length);
        if (left == 1)
          now.time = t;
      }
    boundary_conditions.all_formulas().check(solid.communicator);
    // What results show of supports is their mean force over the interval, as of contact.
    for (const unsigned int i : supports.nodes())
      now.support[i] = support_impulse[i] / (t - start);
    if (impulses)
      {
        impulses->end_interval(now.u, t);
        counts.contact = impulses->work();
      }
    judge();
    counts.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return 0;
  }



  void
  ExplicitStep::cycle(const double length)
  {
    kick(length);
    map.update_ghosts(now.v);
    if (impulses)
      press(length);
    for (const unsigned int i : supports.nodes())
      support_impulse[i] += 0.5 * (now.length + length) * now.support[i];
    for (unsigned int i = 0; i < map.n_local(); ++i)
      now.u[i] += length * now.v[i];
    now.time += length;
    // Forces at both ends of a cycle do work on its motion (doc/explicit.md, section 6).
    add_work(length);
    evaluate_forces(length);
    add_work(length);
    add_damping(length);
    now.length = length;
  }



  void
  ExplicitStep::kick(const double length)
  {
    // Central differences with cycles of different length: the velocities are those in the middle.
    const double between = 0.5 * (now.length + length);
    v_before             = now.v;
    for (unsigned int i = 0; i < map.n_owned(); ++i)
      {
        now.v[i] += between / cells.masses()[i] * now.force(i);
      }
    // Damping with the mean of the velocities before and after, which is stable for any factor.
    for (unsigned int i = 0; i < damping.size(); ++i)
      {
        const double half = 0.5 * damping[i] * between;
        now.v[i]          = (now.v[i] - half * v_before[i]) / (1. + half);
      }
    // Their forces are what changes the velocity, and do work on the mean of those before and
    // after.
    for (const unsigned int i : supports.nodes())
      now.support[i] = now.v[i];
    supports.set_velocities(now.time + length, length, now.u, now.v);
    for (const unsigned int i : supports.nodes())
      {
        // As an impulse of contact it acts together with the damping, see damped_mass().
        now.support[i] = damped_mass(i, between) / between * (now.v[i] - now.support[i]);
        work[i].external += 0.5 * between * (now.support[i] * (v_before[i] + now.v[i]));
      }
  }



  void
  ExplicitStep::press(const double length)
  {
    const double between = 0.5 * (now.length + length);
    if (!damping.empty() && between != mobile_for)
      set_mobilities(between);
    const auto began = std::chrono::steady_clock::now();
    impulses->project(now.u, v_before, now.v, now.time, length, between);
    counts.contact_seconds +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    // What contact exerts along supported directions the supports take.
    impulses->for_each_impulse([&](const unsigned int i, const Tensor<1, dim> &impulse) {
      if (!supports.supported(i))
        return;
      const Tensor<1, dim> taken = impulse - supports.free_part(i, impulse);
      now.support[i] -= taken / between;
      work[i].external -= 0.5 * (taken * (v_before[i] + now.v[i]));
    });
    map.update_ghosts(now.v);
  }



  void
  ExplicitStep::evaluate_forces(const double step)
  {
    const CellPlace failed = cells.evaluate(now.u, now.v, step, now.internal, now.viscous);
    if (!loads.empty())
      loads.evaluate(now.time, now.u, now.external);
    check(failed);
  }



  void
  ExplicitStep::check(const CellPlace &failed) const
  {
    // A sum of squares is not finite if any component is not.
    double sum = 0.;
    for (unsigned int i = 0; i < map.n_owned(); ++i)
      sum += now.v[i].norm_square();
    const bool broken = failed.valid() || !std::isfinite(sum);
    if (Utilities::MPI::max(broken ? 1 : 0, solid.communicator) == 0)
      return;
    // Mistakes of the input come first.
    boundary_conditions.all_formulas().check(solid.communicator);
    char time[60];
    std::snprintf(time, sizeof(time), " at time %.6g: ", now.time);
    const CellPlace first = cells.first(failed);
    if (first.valid())
      throw ExplicitFailure("a cell is turned inside out or its material law has no answer" +
                            (time + first.text(scene.bodies)) +
                            "; it may be crushed between others, or take a finer mesh there, the "
                            "element 'full' or 'F-bar', a smaller 'Courant factor', or a law that "
                            "resists compression");
    CellPlace node;
    for (unsigned int i = 0; i < map.n_owned() && !node.valid(); ++i)
      if (!std::isfinite(now.v[i].norm_square()))
        {
          node.key  = map.key(i);
          node.body = map.body(i);
          for (unsigned int d = 0; d < dim; ++d)
            node.position[d] = map.positions()[i][d];
        }
    throw ExplicitFailure("a velocity is not finite any more" +
                          (time + cells.first(node).text(scene.bodies)) +
                          "; the motion is not stable, take a smaller 'Courant factor'");
  }



  void
  ExplicitStep::add_work(const double length)
  {
    const bool viscous = parameters.linear_viscosity > 0. || parameters.quadratic_viscosity > 0.;
    if (!viscous && loads.empty())
      return;
    for (unsigned int i = 0; i < map.n_owned(); ++i)
      {
        const Tensor<1, dim> half = 0.5 * length * now.v[i];
        if (!loads.empty())
          work[i].external += half * now.external[i];
        if (viscous)
          work[i].viscous -= half * now.viscous[i];
      }
  }



  void
  ExplicitStep::add_damping(const double length)
  {
    // Impulses do work on the mean of the velocities before and after.
    const double between = 0.5 * (now.length + length);
    for (unsigned int i = 0; i < damping.size(); ++i)
      {
        const Tensor<1, dim> mean = 0.5 * (v_before[i] + now.v[i]);
        work[i].damping += between * damping[i] * cells.masses()[i] * (mean * mean);
      }
  }



  void
  ExplicitStep::judge()
  {
    if (parameters.courant_factor > 1.)
      found.warnings.push_back("'Time integration/Courant factor' is above 1: cycles may be longer "
                               "than is stable for a cell by itself");
    const ExplicitCells::Energies of = cells.energies(now.u);
    // Hourglass modes of coarse meshes in bending are of this size.
    constexpr double much = 0.1;
    if (of.hourglass > much * (of.strain + of.plastic) && of.hourglass > 1e-6 * committed.largest)
      found.warnings.push_back(
        "hourglass modes of one-point cells have more than a tenth of the "
        "energy in the bodies: take a finer mesh, distribute loads over more "
        "nodes, or take another 'Element'");
  }



  StepState
  ExplicitStep::state() const
  {
    return {displacement, contact, *this, solid, {}, [this]() {
              return supports.reactions(kept.support);
            }};
  }



  std::string
  ExplicitStep::advice() const
  {
    return "The length of the steps does not matter: see 'Courant factor' and "
           "'Step check interval'.";
  }
} // namespace Touchstone
