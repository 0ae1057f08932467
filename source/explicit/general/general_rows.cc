// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/general/general_contact.h>
#include <touchstone/explicit/row_geometry.h>

#include <algorithm>

// The rows of general contact in the solver of the cycle, and what came of them
// (doc/general_contact.md, section 4).
namespace Touchstone
{
  using namespace dealii;

  void
  GeneralContact::lay_out(std::vector<ImpulseRow> &to, std::vector<std::pair<Index, RowKey>> &slots)
  {
    for (const Row &from : rows)
      {
        ImpulseRow row;
        row.key      = from.key;
        row.first    = slots.size();
        row.n_nodes  = from.sides[0].n + from.sides[1].n;
        row.n_lever  = row.n_nodes;
        row.friction = friction ? &*friction : nullptr;
        // Once for the row, once for its lever.
        for (unsigned int k = 0; k < 2; ++k)
          for (const SurfaceRow::Side &side : from.sides)
            for (unsigned int i = 0; i < side.n; ++i)
              slots.emplace_back(candidates.dof(side.slots[i]), row.key);
        to.push_back(row);
      }
    new_rows = false;
  }



  RowKey
  GeneralContact::slave_of(const RowKey &key)
  {
    return key.pair == SurfaceRow::on_faces ? RowKey{key.pair, key.slave, {}} : key;
  }



  void
  GeneralContact::set_geometry(ImpulseSolver                     &solver,
                               const std::size_t                  first,
                               const std::vector<Tensor<1, dim>> &x,
                               const std::vector<Tensor<1, dim>> &v_before,
                               const double                       step)
  {
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (Row &from = rows[k]; from.used)
        {
          ImpulseRow &row = solver.rows[first + k];
          std::size_t s   = row.first;
          for (unsigned int side = 0; side < 2; ++side)
            for (unsigned int i = 0; i < from.sides[side].n; ++i)
              solver.weights[s++] = (side == 0 ? 1. : -1.) * from.sides[side].weights[i];
          row.impulse = last_impulse(k);
          row.sliding = !sliding.empty() && sliding.count(slave_of(row.key)) > 0;
          row.normal  = from.normal;
          if (row.friction)
            row.tangential = tangential_projector(row.normal);
          set_lever(solver, row, x, from.normal, from.size);
          const double closing = -step * (solver.relative_velocity(row, v_before) * row.normal);
          // An impulse does work on the mean of the velocities before and after: as far as the
          // sides were closing, opening takes none.
          const double allowed = allowed_gap(from.gap, closing, from.size);
          const double most    = std::max(from.gap < 0. ? 0. : allowed, from.gap + closing);
          from.fully_open      = allowed + from.more >= most;
          row.allowed = ((from.gap - std::min(most, allowed + from.more)) / step) * row.normal;
          solver.near.push_back(first + k);
        }
  }



  Tensor<1, dim>
  GeneralContact::last_impulse(const std::size_t k) const
  {
    if (last_impulses[k].epoch == epoch)
      return last_impulses[k].impulse;
    const auto carried = pressed.find(rows[k].key);
    return carried != pressed.end() ? carried->second.impulse : Tensor<1, dim>();
  }



  void
  GeneralContact::remember(const Pressed &what)
  {
    pressed[what.key] = what;
    if (what.sliding)
      sliding.insert(slave_of(what.key));
    if (what.key.pair == SurfaceRow::on_faces)
      {
        if (const std::size_t pair = candidates.find_node(what.key.slave);
            pair < candidates.node_faces.size())
          pressed_nodes[candidates.at_slots.node(candidates.node_faces[pair].node)] = epoch;
      }
    else
      {
        const std::size_t number = candidates.find_edges(
          {{what.key.slave, what.key.others[0], what.key.others[1], what.key.others[2]}});
        if (number < candidates.edge_pairs.size())
          watched.push_back(number);
      }
  }



  void
  GeneralContact::forget()
  {
    ++epoch;
    pressed.clear();
    sliding.clear();
    watched.clear();
  }



  void
  GeneralContact::keep_results(const ImpulseSolver               &solver,
                               const std::size_t                  first,
                               const std::vector<Tensor<1, dim>> &v_before,
                               ExactSum                          &given)
  {
    forget();
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (const ImpulseRow &row = solver.rows[first + k];
          rows[k].used && row.impulse.norm_square() > 0.)
        {
          const Tensor<1, dim> mean =
            0.5 * (solver.relative_velocity(row, v_before) + row.velocity);
          const double normal = (row.impulse * row.normal) * (mean * row.normal);
          const double slip   = row.impulse * mean - normal;
          // What presses an overlap apart is supplied from outside.
          const double supplied = row.allowed * row.normal < 0. ? std::max(0., normal) : 0.;
          energies.normal.add(normal);
          energies.normal.add(-supplied);
          energies.obstacles.add(supplied);
          energies.friction.add(slip);
          given.add(normal);
          given.add(-supplied);
          GeneralResults::RowTotal &total = totals[k];
          total.pressed                   = true;
          total.gap                       = rows[k].gap;
          total.slides                    = !row.friction || row.sliding || total.slides;
          unsigned int node               = 0;
          for (unsigned int side = 0; side < 2; ++side)
            for (unsigned int i = 0; i < rows[k].sides[side].n; ++i)
              total.impulses[node++] +=
                (side == 0 ? 1. : -1.) * rows[k].sides[side].weights[i] * row.impulse;
          last_impulses[k] = {row.impulse, row.friction && row.sliding, epoch};
          if (last_impulses[k].sliding)
            sliding.insert(slave_of(row.key));
          const SurfaceRow::Side &slave = rows[k].sides[0];
          if (row.key.pair == SurfaceRow::on_faces && slave.n == 1)
            {
              press(slave.slots[0], cycles);
              pressed_nodes[candidates.at_slots.node(slave.slots[0])] = epoch;
            }
          else if (rows[k].edges < candidates.edge_pairs.size())
            watched.push_back(rows[k].edges);
        }
  }



  // Where the cycle has taken them.
  std::vector<GeneralContact::Pressed>
  GeneralContact::pressed_rows() const
  {
    std::vector<Pressed> result;
    for (const auto &carried : pressed)
      result.push_back(carried.second);
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (last_impulses[k].epoch == epoch)
        {
          const Row &row = rows[k];
          Pressed    what;
          what.key     = row.key;
          what.impulse = last_impulses[k].impulse;
          what.sliding = last_impulses[k].sliding;
          what.lower = what.upper = Point<dim>(moving.at(row.sides[0].slots[0]).x);
          // Of inner edges the slave side alone does not say on which rank their candidates are.
          for (unsigned int side = 0; side < (row.key.pair == SurfaceRow::on_edges ? 2U : 1U);
               ++side)
            for (unsigned int i = 0; i < row.sides[side].n; ++i)
              {
                const NodeMotion &of = moving.at(row.sides[side].slots[i]);
                for (const Tensor<1, dim> &x : {of.x, of.x + moving.cycle * of.v})
                  for (unsigned int d = 0; d < dim; ++d)
                    {
                      what.lower[d] = std::min(what.lower[d], x[d]);
                      what.upper[d] = std::max(what.upper[d], x[d]);
                    }
              }
          result.push_back(what);
        }
    return result;
  }



  void
  GeneralContact::keep_totals()
  {
    for (std::size_t k = 0; k < totals.size(); ++k)
      if (totals[k].pressed)
        {
          std::array<Index, 8> dofs{};
          unsigned int         n = 0;
          for (const SurfaceRow::Side &side : rows[k].sides)
            for (unsigned int i = 0; i < side.n; ++i)
              dofs[n++] = candidates.dof(side.slots[i]);
          outcome.add(dofs, n, totals[k]);
          totals[k] = GeneralResults::RowTotal();
        }
  }



  void
  GeneralContact::end_interval(const double length)
  {
    keep_totals();
    outcome.end_interval(length);
  }
} // namespace Touchstone
