// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/interruption.h>
#include <touchstone/base/non_convergence.h>
#include <touchstone/drive/explicit_step.h>
#include <touchstone/solid/thermal_strain.h>

#include <chrono>
#include <cmath>
#include <cstdio>

// One cycle of explicit dynamics: velocities, contact, displacements, forces and their work
// (doc/explicit.md, sections 1 and 6).
namespace Touchstone
{
  using namespace dealii;

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
  ExplicitStep::cycle(const double length, const unsigned int halved)
  {
    constexpr unsigned int most_halvings = 12;
    kick(length);
    map.update_ghosts(now.v);
    if (impulses)
      impulses->tool_nodes().kick(now.time, 0.5 * (now.length + length));
    if (impulses && !press(length))
      {
        if (halved == most_halvings)
          {
            // Surfaces cannot be kept apart where their cells have passed through themselves.
            check_inverted();
            throw ExplicitFailure(impulses->general_contact()->failure(now.time));
          }
        now.v = v_before;
        impulses->tool_nodes().restore();
        cycle(0.5 * length, halved + 1);
        cycle(0.5 * length, halved + 1);
        return;
      }
    ++counts.cycles;
    counts.smallest_step = std::min(counts.smallest_step, length);
    add_support_work(length);
    for (std::size_t k = 0; k < now.support.size(); ++k)
      support_impulse[k] += 0.5 * (now.length + length) * now.support[k];
    for (unsigned int i = 0; i < map.n_local(); ++i)
      now.u[i] += length * now.v[i];
    if (impulses)
      impulses->tool_nodes().advance(length);
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
    if (!v_before.empty())
      v_before = now.v;
    for (unsigned int i = 0; i < map.n_owned(); ++i)
      now.v[i] += between / cells.masses()[i] * now.force(i);
    // Damping with the mean of the velocities before and after, which is stable for any factor.
    for (unsigned int i = 0; i < damping.size(); ++i)
      {
        const double half = 0.5 * damping[i] * between;
        now.v[i]          = (now.v[i] - half * v_before[i]) / (1. + half);
      }
    // Their forces are what changes the velocity, and do work on the mean of those before and
    // after.
    for (std::size_t k = 0; k < now.support.size(); ++k)
      now.support[k] = now.v[supports.nodes()[k]];
    supports.set_velocities(now.time + length, length, now.u, now.v);
    for (std::size_t k = 0; k < now.support.size(); ++k)
      {
        // As an impulse of contact it acts together with the damping, see damped_mass().
        const unsigned int i = supports.nodes()[k];
        now.support[k]       = damped_mass(i, between) / between * (now.v[i] - now.support[k]);
      }
  }



  // Supports fix the motion along the directions in which they act: contact does not change it.
  void
  ExplicitStep::add_support_work(const double length)
  {
    const double between = 0.5 * (now.length + length);
    for (std::size_t k = 0; k < now.support.size(); ++k)
      {
        const unsigned int i = supports.nodes()[k];
        work.external[i] += 0.5 * between * (now.support[k] * (v_before[i] + now.v[i]));
      }
  }



  bool
  ExplicitStep::press(const double length)
  {
    const double between = 0.5 * (now.length + length);
    if (!damping.empty() && between != mobile_for)
      set_mobilities(between);
    const auto began    = std::chrono::steady_clock::now();
    const bool possible = impulses->project(now.u, v_before, now.v, now.time, length, between);
    counts.contact_seconds +=
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    if (!possible)
      return false;
    // What contact exerts along supported directions the supports take.
    impulses->for_each_impulse([&](const unsigned int i, const Tensor<1, dim> &impulse) {
      if (!supports.supported(i))
        return;
      const Tensor<1, dim> taken = impulse - supports.free_part(i, impulse);
      now.support[supports.place(i)] -= taken / between;
    });
    map.update_ghosts(now.v);
    return true;
  }



  void
  ExplicitStep::evaluate_forces(const double step)
  {
    const CellPlace failed =
      cells.evaluate(now.u, now.v, now.time, step, now.internal, now.viscous);
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
    // One message for both: numbers of signals are far below.
    constexpr int is_broken = 1000;
    const int     event =
      Utilities::MPI::max(broken ? is_broken : Interruption::pending(), solid.communicator);
    if (event == 0)
      return;
    if (event < is_broken)
      throw Interruption(event);
    // Mistakes of the input come first.
    boundary_conditions.all_formulas().check(solid.communicator);
    check_temperatures(solid, now.time);
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
          work.external[i] += half * now.external[i];
        if (viscous)
          work.viscous[i] -= half * now.viscous[i];
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
        work.damping[i] += between * damping[i] * cells.masses()[i] * (mean * mean);
      }
  }
} // namespace Touchstone
