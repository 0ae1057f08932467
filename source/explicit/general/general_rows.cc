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
          row.impulse = impulses.impulse(k, row.key);
          row.sliding = impulses.slides(row.key);
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



  void
  GeneralContact::keep_results(const ImpulseSolver               &solver,
                               const std::size_t                  first,
                               const std::vector<Tensor<1, dim>> &v_before,
                               ExactSum                          &given)
  {
    impulses.forget();
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
          impulses.keep(k, rows[k], row.impulse, row.friction && row.sliding);
        }
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
