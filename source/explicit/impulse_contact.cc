// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/impulse_contact.h>
#include <touchstone/explicit/infeasible_contact.h>

#include <algorithm>
#include <cmath>
#include <limits>

// Contact in a cycle (doc/explicit.md, section 9): are the rows still those of the motion; where do
// they stand; what impulses do they need; and what came of them. The geometry of a cycle is in
// impulse_geometry.cc.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    ImpulseEnforcement &
    by_impulses(Enforcement &enforcement)
    {
      auto *const result = dynamic_cast<ImpulseEnforcement *>(&enforcement);
      AssertThrow(result != nullptr, ExcMessage("explicit steps need an enforcement by impulses"));
      return *result;
    }
  } // namespace



  ImpulseContact::ImpulseContact(Contact                 &contact,
                                 const ContactParameters &parameters,
                                 const NodeMap           &nodes)
    : contact(contact)
    , enforcement(by_impulses(contact.enforcement()))
    , parameters(parameters)
    , nodes(nodes)
    , solver(nodes.communicator())
    , motion(contact, nodes)
    , displacement(contact.solid_model().owned, contact.communicator())
    , history(contact.rows().size())
    , inverse_masses(nodes.n_owned())
  {
    find_patches();
  }



  // The moment of a force that does not act along the gap vector is taken up around the slave node:
  // these faces are known here whole, and never degenerate.
  void
  ImpulseContact::find_patches()
  {
    patches.resize(contact.rows().size());
    for (const ContactRow &row : contact.rows())
      if (const ContactPair &pair = contact.pair(row); pair.master())
        {
          auto faces = pair.slave().faces_around(row.slave);
          std::sort(faces.begin(), faces.end(), [](const auto &a, const auto &b) {
            return a.first->key < b.first->key;
          });
          std::vector<Index> &patch = patches[row.index];
          for (const auto &[face, m] : faces)
            for (unsigned int i = 0; i < face->n_nodes(); ++i)
              if (std::find(patch.begin(), patch.end(), dim * face->nodes[i]) == patch.end())
                patch.push_back(dim * face->nodes[i]);
        }
  }



  void
  ImpulseContact::set_mobility(const std::vector<SymmetricTensor<2, dim>> &inverse_mass)
  {
    std::copy_n(inverse_mass.begin(), nodes.n_owned(), inverse_masses.begin());
    for (unsigned int node = 0; node < solver.nodes.n_owned(); ++node)
      solver.mobility[node] = inverse_masses[local[node]];
    solver.nodes.forward(solver.mobility);
  }



  void
  ImpulseContact::begin_interval()
  {
    renew_rows = true;
    // Everything from the committed state, which is what a checkpoint has: sweeps begin from no
    // impulses.
    for (const ContactRow &row : contact.rows())
      {
        history[row.index]         = RowHistory();
        history[row.index].sliding = contact.state(row).status == ContactStatus::slip;
      }
  }



  void
  ImpulseContact::renew(const NodeField &u, const double time)
  {
    ++counted.renewals;
    nodes.to_vector(u, displacement);
    // Rows in contact leave an edge later than open ones arrive there.
    if (!renew_rows)
      for (const ContactRow &row : contact.rows())
        {
          RowState state = enforcement.states()[row];
          if (state.status != ContactStatus::no_partner && !row.tied)
            state.status = history[row.index].impulse * row.normal > 0. ? ContactStatus::slip
                                                                        : ContactStatus::open;
          enforcement.set_state(row, state);
        }
    contact.update(displacement, time);
    contact.commit_positions();
    make_rows();
    motion.restart(u);
    renew_rows = false;
  }



  void
  ImpulseContact::make_rows()
  {
    std::vector<std::pair<Index, RowKey>> slots;
    solver.rows.clear();
    kept.clear();
    kept_rows.clear();
    for (const ContactRow &from : contact.rows())
      {
        if (!from.has_partner)
          {
            history[from.index].impulse = Tensor<1, dim>();
            continue;
          }
        ImpulseRow row;
        row.key      = {from.pair, nodes.key(nodes.local(dim * from.slave))};
        row.first    = slots.size();
        row.n_nodes  = 1 + from.stencil.size();
        row.n_lever  = from.stencil.empty() ? 0 : patches[from.index].size();
        row.tied     = from.tied;
        row.friction = from.friction;
        row.area     = from.area;
        slots.emplace_back(dim * from.slave, row.key);
        for (const StencilEntry &entry : from.stencil)
          slots.emplace_back(dim * entry.node, row.key);
        if (row.n_lever > 0)
          for (const Index dof : patches[from.index])
            slots.emplace_back(dof, row.key);
        solver.rows.push_back(row);
        kept.push_back({from.index,
                        from.gap,
                        from.gap_vector,
                        contact.pair(from).part_of_overlap(contact.time())});
        kept_rows.push_back(from.index);
      }
    solver.nodes.reinit(contact.solid_model().owned, slots);
    solver.resize();
    const RowNodes &on = solver.nodes;
    local.resize(on.n_owned());
    reference.resize(on.n());
    u_nodes.resize(on.n());
    std::vector<std::uint64_t> keys(on.n());
    for (unsigned int node = 0; node < on.n_owned(); ++node)
      {
        local[node]           = nodes.local(on.dof(node));
        keys[node]            = nodes.key(local[node]);
        reference[node]       = nodes.positions()[local[node]];
        solver.mobility[node] = inverse_masses[local[node]];
        for (unsigned int d = 0; d < dim; ++d)
          u_nodes[node][d] = displacement(on.dof(node) + d);
      }
    on.forward(keys);
    on.forward(reference);
    on.forward(u_nodes);
    on.forward(solver.mobility);
    solver.sort_slots(keys);
    for (std::size_t k = 0; k < kept.size(); ++k)
      {
        const ContactRow &from = contact.rows()[kept[k].index];
        ImpulseRow       &row  = solver.rows[k];
        std::size_t       s    = row.first;
        solver.weights[s++]    = 1.;
        for (const StencilEntry &entry : from.stencil)
          solver.weights[s++] = -entry.weight;
        // The gaps that the row would have at zero displacements.
        Tensor<1, dim> by_motion;
        for (unsigned int i = 0; i < row.n_nodes; ++i)
          {
            const std::size_t slot = solver.slot(row, i);
            by_motion += solver.weights[slot] * u_nodes[solver.nodes.node(slot)];
          }
        kept[k].gap_vector -= by_motion;
        kept[k].gap -= by_motion * from.normal;
      }
    made_at = u_nodes;
    moved.resize(u_nodes.size());
    v_before.resize(u_nodes.size());
  }



  void
  ImpulseContact::import(const NodeField &u, const NodeField &before, const NodeField &v)
  {
    for (unsigned int node = 0; node < solver.nodes.n_owned(); ++node)
      {
        u_nodes[node]         = u[local[node]];
        v_before[node]        = before[local[node]];
        solver.velocity[node] = v[local[node]];
      }
    solver.nodes.forward(u_nodes);
    solver.nodes.forward(v_before);
    solver.nodes.forward(solver.velocity);
  }



  void
  ImpulseContact::project(const NodeField &u,
                          const NodeField &before,
                          NodeField       &v,
                          const double     time,
                          const double     step)
  {
    if (renew_rows)
      {
        interval_start = time;
        renew(u, time);
        import(u, before, v);
      }
    else
      {
        import(u, before, v);
        for (unsigned int node = 0; node < solver.nodes.n(); ++node)
          moved[node] = u_nodes[node] + step * solver.velocity[node] - made_at[node];
        if (motion.demands_rows(u, v, step, solver, kept_rows, moved))
          {
            renew(u, time);
            import(u, before, v);
          }
      }
    set_geometry(time, step);
    ImpulseControl control;
    control.tolerance          = parameters.impulse_tolerance;
    control.sweeps             = enforcement.one_sweep() ? 1 : parameters.most_sweeps;
    control.one_sweep          = enforcement.one_sweep();
    control.step               = step;
    control.time               = time + step;
    const ImpulseCounts counts = solver.solve(control);
    ++counted.cycles;
    counted.sweeps += counts.sweeps;
    counted.most_sweeps = std::max(counted.most_sweeps, counts.sweeps);
    counted.unconverged += !counts.converged && !control.one_sweep;
    acted = counts.rounds > 0;
    if (!acted)
      {
        for (RowHistory &row : history)
          {
            row.impulse = Tensor<1, dim>();
            row.sliding = false;
          }
        return;
      }
    check_feasible(step, counts.converged || control.one_sweep);
    for (unsigned int node = 0; node < solver.nodes.n_owned(); ++node)
      v[local[node]] = solver.velocity[node];
    keep_results(step);
  }



  void
  ImpulseContact::check_feasible(const double step, const bool converged) const
  {
    // Penetrations relative to the size of faces that are taken to be no matter of round-off or of
    // a sweep too few.
    constexpr double of_supports = 1e-3, of_others = 0.1;
    unsigned int     pair = contact.n_pairs();
    for (std::size_t k = 0; k < kept.size(); ++k)
      {
        const ImpulseRow &row  = solver.rows[k];
        const ContactRow &from = contact.rows()[kept[k].index];
        const double      gap  = step * ((row.velocity + row.allowed) * row.normal);
        if (!row.tied && ((row.blocked && gap < -of_supports * from.size) ||
                          (!converged && gap < -of_others * from.size)))
          pair = std::min(pair, from.pair);
      }
    pair = Utilities::MPI::min(pair, nodes.communicator());
    if (pair < contact.n_pairs())
      throw InfeasibleContact(contact.pair(pair).parameters());
  }



  void
  ImpulseContact::keep_results(const double step)
  {
    for (std::size_t k = 0; k < kept.size(); ++k)
      {
        const ImpulseRow &row = solver.rows[k];
        RowHistory       &h   = history[kept[k].index];
        h.impulse             = row.impulse;
        h.sliding             = row.sliding;
        if (row.impulse.norm_square() == 0.)
          continue;
        const double         p_n  = row.impulse * row.normal;
        const Tensor<1, dim> p_t  = row.tied ? Tensor<1, dim>() : row.impulse - p_n * row.normal;
        const Tensor<1, dim> mean = 0.5 * (solver.relative_velocity(row, v_before) + row.velocity);
        const double         by_slip = p_t * mean;
        h.total += row.impulse;
        // What overlaps that are pressed apart give is supplied like the work of obstacles.
        const double supplied = row.tied ? 0. : std::max(0., -row.allowed * row.normal) * p_n;
        h.energy.normal += row.impulse * mean - by_slip - supplied;
        h.energy.friction += by_slip;
        h.energy.obstacles += row.impulse * row.drive + supplied;
        h.pressed = true;
        if (!row.friction)
          continue;
        const Tensor<1, dim> slip = step * (row.tangential * row.velocity);
        h.slip += slip;
        h.path += slip.norm();
        h.friction_work -= p_t * slip / step;
        h.slipped = h.slipped || row.sliding;
      }
  }



  ImpulseEnergy
  ImpulseContact::energy() const
  {
    ExactSum normal, friction, obstacles;
    for (const RowHistory &row : history)
      {
        normal.add(row.energy.normal);
        friction.add(row.energy.friction);
        obstacles.add(row.energy.obstacles);
      }
    return {normal.value(nodes.communicator()),
            friction.value(nodes.communicator()),
            obstacles.value(nodes.communicator())};
  }



  void
  ImpulseContact::end_interval(const NodeField &u, const double time)
  {
    nodes.to_vector(u, displacement);
    contact.update(displacement, time);
    const double length = time - interval_start;
    for (const ContactRow &row : contact.rows())
      {
        const RowHistory &h = history[row.index];
        RowState          state;
        if (row.has_partner)
          {
            state.force    = length > 0. ? h.total / length : Tensor<1, dim>();
            state.lambda   = state.force * row.normal;
            state.status   = row.tied                     ? ContactStatus::tied
                             : !h.pressed                 ? ContactStatus::open
                             : row.friction && !h.slipped ? ContactStatus::stick
                                                          : ContactStatus::slip;
            state.accepted = state.active();
          }
        enforcement.set_state(row, state);
        if (row.friction)
          contact.record_friction(
            row, state.force - state.lambda * row.normal, h.slip, h.path, h.friction_work);
      }
  }
} // namespace Touchstone
