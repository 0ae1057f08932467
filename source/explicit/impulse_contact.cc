// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/impulse_contact.h>

#include <algorithm>
#include <cmath>
#include <limits>

// Contact in a cycle (doc/explicit.md, section 9): are the rows still those of the motion; where do
// they stand; what impulses do they need; and what came of them. The rows are made in
// impulse_rows.cc, the geometry of a cycle is in impulse_geometry.cc, springs are in
// impulse_springs.cc, results in impulse_results.cc.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    const ImpulseRule &
    rule_of(const Enforcement &enforcement)
    {
      const ImpulseRule *const rule = enforcement.impulse_rule();
      AssertThrow(rule != nullptr, ExcMessage("the enforcement does not serve explicit steps"));
      return *rule;
    }
  } // namespace



  ImpulseContact::ImpulseContact(Contact                               &contact,
                                 const ContactParameters               &parameters,
                                 const NodeMap                         &nodes,
                                 const std::vector<BodyParameters>     &bodies,
                                 const std::vector<ObstacleParameters> &obstacles,
                                 std::unique_ptr<GeneralContact>        general)
    : contact(contact)
    , rule(rule_of(contact.enforcement()))
    , parameters(parameters)
    , nodes(nodes)
    , solver(nodes.communicator())
    , motion(contact, nodes)
    , surfaces(contact, nodes)
    , planes(contact, nodes)
    , displacement(contact.solid_model().owned, contact.communicator())
    , general(std::move(general))
    , tools(obstacles, contact)
    , history(contact.rows().size())
    , inverse_masses(nodes.n_owned())
  {
    contact.follow_cycles();
    find_patches();
    find_smallest_faces();
    springs.reinit(contact.rows());
    if (rule.method == ImpulseRule::Method::bulk_springs)
      stiffness_of_cells = contact_stiffness(contact, nodes, bodies);
  }



  void
  ImpulseContact::set_mobility(const std::vector<SymmetricTensor<2, dim>> &inverse_mass)
  {
    std::copy_n(inverse_mass.begin(), nodes.n_owned(), inverse_masses.begin());
    for (unsigned int node = 0; node < local.size(); ++node)
      solver.mobility[node] = inverse_masses[local[node]];
    solver.nodes.forward(solver.mobility);
  }



  void
  ImpulseContact::import(const NodeField &u, const NodeField &before, const NodeField &v)
  {
    for (unsigned int node = 0; node < local.size(); ++node)
      {
        u_nodes[node]         = u[local[node]];
        v_before[node]        = before[local[node]];
        solver.velocity[node] = v[local[node]];
      }
    for (unsigned int node = local.size(); node < solver.nodes.n_owned(); ++node)
      {
        // Gaps count from where an obstacle is, so that it has no displacement.
        const Index dof       = solver.nodes.dof(node);
        v_before[node]        = tools.velocity_before(dof);
        solver.velocity[node] = tools.velocity(dof);
        solver.mobility[node] = tools.mobility(dof);
      }
    if (!tools.empty())
      solver.nodes.forward(solver.mobility);
    solver.nodes.forward(u_nodes);
    solver.nodes.forward(v_before);
    solver.nodes.forward(solver.velocity);
    for (unsigned int node = 0; node < solver.nodes.n(); ++node)
      x_nodes[node] = reference[node] + u_nodes[node];
    if (general)
      v_free = solver.velocity;
  }



  // Where impulses move nodes farther than candidates have been found for, more are found: a cycle
  // that is halved would change the energy.
  bool
  ImpulseContact::project(const NodeField &u,
                          const NodeField &before,
                          NodeField       &v,
                          const double     time,
                          const double     step,
                          const double     acting)
  {
    constexpr double farthest = 8.;
    for (double reach = 1.;; reach *= 2.)
      {
        const auto found = project_within(reach, u, before, v, time, step, acting);
        if (found == GeneralContact::Crossings::none)
          return true;
        if (found != GeneralContact::Crossings::too_far || reach == farthest)
          break;
      }
    ++counted.halvings;
    return false;
  }



  GeneralContact::Crossings
  ImpulseContact::project_within(const double     reach,
                                 const NodeField &u,
                                 const NodeField &before,
                                 NodeField       &v,
                                 const double     time,
                                 const double     step,
                                 const double     acting)
  {
    using Crossings = GeneralContact::Crossings;
    check_obstacles(time, step);
    if (surfaces.needed())
      {
        speeds_before = speeds;
        if (untouched)
          surfaces.measure({{&v, &speeds}});
        else
          surfaces.measure({{&before, &speeds_before}, {&v, &speeds}});
      }
    untouched = false;
    fastest   = std::max(fastest, speeds_before.apart);
    // Forces act from the middle of the cycle before; the first cycle has none before it.
    if (general)
      general->begin_cycle(u, before, time > 0. ? 2. * acting - step : 0., v, step, false, reach);
    const bool imported = bring_rows(u, before, v, time, step);
    if (general && general->must_lay_out())
      lay_out(u);
    last_step = step;
    if (parted || (all_asleep(time, step) && !(general && general->any())))
      {
        ++counted.cycles;
        end_of_action();
        untouched = true;
        return Crossings::none;
      }
    if (!imported || general)
      import(u, before, v);
    set_geometry(time, step);
    ImpulseCounts counts =
      rule.springs() ? push(time, step, acting > 0. ? acting : step) : solve(time, step);
    if (general)
      if (const auto found = keep_apart(u, before, v, time, step, counts); found != Crossings::none)
        return found;
    if (counts.rounds > 0 && !rule.springs())
      check_feasible(step, counts.converged || rule.method == ImpulseRule::Method::one_sweep);
    keep_drives();
    ++counted.cycles;
    counted.sweeps += counts.sweeps + counts.on_faces;
    counted.rounds += counts.rounds;
    counted.most_sweeps =
      std::max<std::uint64_t>(counted.most_sweeps, counts.sweeps + counts.on_faces);
    fresh = false;
    if (counts.rounds == 0)
      {
        end_of_action();
        untouched = !general;
        if (surfaces.needed() && !rule.springs())
          {
            all_asleep_until = std::numeric_limits<double>::max();
            for (const double until : asleep_until)
              all_asleep_until = std::min(all_asleep_until, until);
            all_asleep_until = Utilities::MPI::min(all_asleep_until, nodes.communicator());
          }
        return Crossings::none;
      }
    acted            = true;
    all_asleep_until = 0.;
    take_velocities(v);
    keep_results(step);
    if (rule.springs())
      keep_springs(step);
    return Crossings::none;
  }



  void
  ImpulseContact::take_velocities(NodeField &v)
  {
    for (unsigned int node = 0; node < local.size(); ++node)
      v[local[node]] = solver.velocity[node];
    for (unsigned int node = local.size(); node < solver.nodes.n_owned(); ++node)
      tools.take(solver.nodes.dof(node), solver.velocity[node]);
    tools.spread();
  }



  // Rows that keep surfaces from crossing change the motion of others: until none crosses.
  GeneralContact::Crossings
  ImpulseContact::keep_apart(const NodeField &u,
                             const NodeField &before,
                             NodeField       &v,
                             const double     time,
                             const double     step,
                             ImpulseCounts   &counts)
  {
    constexpr unsigned int most_rounds = 40;
    for (unsigned int round = 1; general->any(); ++round)
      {
        for (unsigned int node = 0; node < local.size(); ++node)
          v[local[node]] = solver.velocity[node];
        const auto found = general->find_crossings(u, v, step, round);
        if (found == GeneralContact::Crossings::none)
          {
            counted.crossing_rounds += round;
            counted.most_crossing_rounds =
              std::max<std::uint64_t>(counted.most_crossing_rounds, round);
            counted.many_crossing_rounds += round > 5;
            break;
          }
        for (unsigned int node = 0; node < local.size(); ++node)
          v[local[node]] = v_free[node];
        if (found != GeneralContact::Crossings::rows || round == most_rounds)
          return found;
        if (general->must_lay_out())
          lay_out(u);
        import(u, before, v);
        set_geometry(time, step);
        const ImpulseCounts more = solve(time, step);
        counts.sweeps += more.sweeps;
        counts.on_faces += more.on_faces;
        counts.rounds += more.rounds;
        counts.converged = more.converged;
      }
    return GeneralContact::Crossings::none;
  }



  void
  ImpulseContact::keep_drives()
  {
    for (const std::size_t k : solver.near)
      if (k < kept.size() && contact.rows()[kept[k].index].get().stencil.empty()) // of an obstacle
        {
          RowHistory &h = history[kept[k].index];
          h.drive       = solver.rows[k].drive;
          h.driven      = true;
        }
  }



  void
  ImpulseContact::end_of_action()
  {
    if (acted)
      for (RowHistory &row : history)
        {
          row.impulse       = Tensor<1, dim>();
          row.sliding       = false;
          row.energy.ahead  = 0.;
          row.energy.stored = 0.;
        }
    if (acted && general)
      general->forget();
    acted = false;
  }



  ImpulseControl
  ImpulseContact::control(const double time, const double step) const
  {
    ImpulseControl result;
    result.tolerance  = parameters.impulse_tolerance;
    result.one_sweep  = rule.method == ImpulseRule::Method::one_sweep;
    result.sweeps     = result.one_sweep ? 1 : parameters.most_sweeps;
    result.accelerate = rule.method == ImpulseRule::Method::projection;
    result.relaxation = result.accelerate ? 1. : rule.factor;
    result.step       = step;
    result.time       = time + step;
    return result;
  }



  ImpulseCounts
  ImpulseContact::solve(const double time, const double step)
  {
    const bool          one_sweep = rule.method == ImpulseRule::Method::one_sweep;
    const ImpulseCounts counts    = solver.solve(control(time, step));
    counted.unconverged += !counts.converged && !one_sweep;
    return counts;
  }



  void
  ImpulseContact::commit()
  {
    springs.commit();
    tools.commit();
  }



  void
  ImpulseContact::rollback()
  {
    springs.rollback();
    tools.rollback();
  }



  void
  ImpulseContact::save(ArchiveWriter &archive) const
  {
    if (rule.springs())
      springs.save(archive);
    tools.save(archive);
  }



  void
  ImpulseContact::load(const ArchiveReader &archive)
  {
    if (rule.springs())
      springs.load(archive);
    tools.load(archive);
  }
} // namespace Touchstone
