// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exact_sum.h>
#include <touchstone/explicit/impulse_contact.h>
#include <touchstone/explicit/infeasible_contact.h>
#include <touchstone/explicit/row_geometry.h>

#include <algorithm>

// What came of the impulses of a cycle, and of those of an output interval (doc/explicit.md,
// sections 6 and 9.6).
namespace Touchstone
{
  using namespace dealii;

  void
  ImpulseContact::check_feasible(const double step, const bool converged) const
  {
    // Penetrations relative to the size of faces that are taken to be no matter of round-off or of
    // a sweep too few.
    constexpr double of_supports = 1e-3, of_others = 0.1;
    unsigned int     pair = contact.n_pairs();
    for (const std::size_t k : solver.near)
      {
        if (k >= kept.size())
          break; // of general contact, whose check of crossings follows
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



  // What the impulse of a row does in the cycle. Where an overlap is pressed apart what it gives is
  // supplied from outside like the work of obstacles; springs have no such demand.
  void
  ImpulseContact::add_energy(const ImpulseRow &row, RowHistory &h) const
  {
    const double         p_n     = row.impulse * row.normal;
    const Tensor<1, dim> p_t     = row.tied ? Tensor<1, dim>() : row.impulse - p_n * row.normal;
    const Tensor<1, dim> mean    = 0.5 * (velocity_before(row, h) + row.velocity);
    const double         by_slip = p_t * mean, by_normal = row.impulse * mean - by_slip;
    const double         supplied =
      !row.tied && !rule.springs() && row.allowed * row.normal < 0. ? std::max(0., by_normal) : 0.;
    h.total += row.impulse;
    h.energy.normal += by_normal - supplied;
    h.energy.friction += by_slip;
    // The motion of an obstacle that forces move is in the relative velocity.
    Tensor<1, dim> drive_before = h.drive_before, drive = row.drive;
    if (row.key.pair < contact.n_pairs() && tools.shift_dof(row.key.pair) != invalid_index)
      {
        const unsigned int slave = solver.nodes.node(row.first);
        drive_before             = v_before[slave] - velocity_before(row, h);
        drive                    = solver.velocity[slave] - row.velocity;
      }
    h.energy.obstacles += row.impulse * (0.5 * (drive_before + drive)) + supplied;
    h.energy.ahead = 0.5 * (row.impulse * drive);
    h.pressed      = true;
  }



  void
  ImpulseContact::keep_results(const double step)
  {
    ExactSum given;
    for (const std::size_t k : solver.near)
      {
        if (k >= kept.size())
          break;
        const ImpulseRow &row = solver.rows[k];
        RowHistory       &h   = history[kept[k].index];
        h.impulse             = row.impulse;
        h.sliding             = row.sliding;
        h.energy.ahead        = 0.;
        if (row.impulse.norm_square() == 0.)
          continue;
        const double before = h.energy.normal;
        add_energy(row, h);
        given.add(h.energy.normal);
        given.add(-before);
        if (!row.friction || rule.springs())
          continue;
        const Tensor<1, dim> p_t  = row.impulse - (row.impulse * row.normal) * row.normal;
        const Tensor<1, dim> slip = step * (row.tangential * row.velocity);
        h.slip += slip;
        h.path += slip.norm();
        h.friction_work -= p_t * slip / step;
        h.slipped = h.slipped || row.sliding;
      }
    if (general)
      general->keep_results(solver, kept.size(), v_before, given);
    if (!rule.springs())
      counted.most_given = std::max(counted.most_given, given.value(nodes.communicator()));
  }



  ImpulseEnergy
  ImpulseContact::energy() const
  {
    ExactSum normal, friction, obstacles, ahead, stored;
    for (const RowHistory &row : history)
      {
        normal.add(row.energy.normal);
        friction.add(row.energy.friction);
        obstacles.add(row.energy.obstacles);
        ahead.add(row.energy.ahead);
        stored.add(row.energy.stored);
      }
    if (general)
      {
        normal.add(general->energy().normal);
        friction.add(general->energy().friction);
        obstacles.add(general->energy().obstacles);
      }
    return {normal.value(nodes.communicator()),
            friction.value(nodes.communicator()),
            obstacles.value(nodes.communicator()),
            ahead.value(nodes.communicator()),
            stored.value(nodes.communicator())};
  }



  ImpulseWork
  ImpulseContact::work() const
  {
    ImpulseWork result = counted;
    if (general)
      result.search = general->counts();
    return result;
  }



  void
  ImpulseContact::end_interval(const NodeField &u, const double time)
  {
    nodes.to_vector(u, displacement);
    tell_what_presses();
    contact.update(displacement, time);
    const double length = time - interval_start;
    if (general)
      general->end_interval(length);
    for (const ContactRow &row : contact.rows())
      {
        const RowHistory &h = history[row.index];
        RowState          state;
        if (row.has_partner)
          {
            // On the slave node, as rows of Contact are.
            state.force  = length > 0. ? weight_of_slave(row) * h.total / length : Tensor<1, dim>();
            state.lambda = state.force * row.normal;
            state.status = row.tied                     ? ContactStatus::tied
                           : !h.pressed                 ? ContactStatus::open
                           : row.friction && !h.slipped ? ContactStatus::stick
                                                        : ContactStatus::slip;
            state.accepted = state.active();
          }
        contact.enforcement().set_state(row, state);
        if (row.friction)
          contact.record_friction(
            row, state.force - state.lambda * row.normal, h.slip, h.path, h.friction_work);
      }
  }
} // namespace Touchstone
