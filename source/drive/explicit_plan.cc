// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/non_convergence.h>
#include <touchstone/drive/explicit_step.h>
#include <touchstone/explicit/assembled_frequency.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

// The length of the cycles of explicit dynamics (doc/explicit.md, section 4).
namespace Touchstone
{
  using namespace dealii;

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
    for (unsigned int c = 0; c < map.cells().size(); ++c)
      for (unsigned int axis = 0; axis < dim; ++axis)
        size = std::min(
          size,
          (map.positions()[map.nodes(c)[1U << axis]] - map.positions()[map.nodes(c)[0]]).norm());
    size = Utilities::MPI::min(size, solid.communicator);
    const NodeField at_rest(map.n_local());
    NodeField       viscous(map.n_local());
    const double    square = assembled_square_frequency(
      map,
      cells.masses(),
      now.u,
      [&](NodeField &u, NodeField &force) {
        cells.evaluate(u, at_rest, now.time, 0., force, viscous);
      },
      size);
    // The bound of the cells is one for the mesh, too.
    assembled_to_cells = std::max(1., 2. / std::sqrt(square) / of_cells);
  }



  // Damping in proportion to the mass is stable in cycles of any length, but what is left of a
  // velocity, (1 - a h/2)/(1 + a h/2), is exp(-a h) for short ones alone: ways are right to 0.3 %.
  void
  ExplicitStep::shorten_for_damping()
  {
    constexpr double most = 0.2;
    double           a    = 0.;
    for (const BodyParameters &body : scene.bodies)
      a = std::max(a, body.material.rayleigh_mass);
    if (a * counts.stable_step <= most)
      return;
    counts.stable_step = most / a;
    counts.cell        = "the damping of 'Rayleigh mass'";
  }



  ExplicitStep::Plan
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
    counts.stable_step = with_springs(counts.stable_step, loads.square_frequency(cells.masses()));
    if (impulses)
      counts.stable_step = with_springs(counts.stable_step,
                                        impulses->square_frequency(now.u, now.time, stable.length));
    shorten_for_damping();
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
    Plan plan;
    plan.cycles = std::max(1., n);
    // Cells that are compressed faster are looked at earlier.
    const double ahead = std::floor(stable.holds / ((t - now.time) / plan.cycles));
    plan.next          = std::clamp(ahead, 1., double(parameters.check_interval));
    return plan;
  }
} // namespace Touchstone
