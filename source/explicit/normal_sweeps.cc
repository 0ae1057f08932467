// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/impulse_solver.h>

#include <algorithm>
#include <cmath>

// Sweeps where forces act along the normals of all rows (doc/explicit.md, section 9.2): an impulse
// is one number, and what it does to each of its nodes one vector. The rows that take part lie one
// behind the other in the order of their keys, and so do sums at a node.
namespace Touchstone
{
  using namespace dealii;

  void
  ImpulseSolver::collect_acting()
  {
    std::vector<unsigned char> acts(rows.size(), 0);
    for (const std::size_t k : near)
      acts[k] = active[k];
    entries.clear();
    acting.clear();
    for (const std::size_t k : by_key)
      if (acts[k])
        {
          const ImpulseRow &row     = rows[k];
          const double      impulse = row.impulse * row.normal;
          acting.push_back({k,
                            entries.size(),
                            row.allowed * row.normal,
                            row.drive * row.normal,
                            0.,
                            impulse,
                            impulse,
                            impulse});
          std::size_t s = row.first;
          for (const std::size_t end = s + row.n_nodes; s < end; ++s)
            {
              const unsigned int slot = order[s];
              entries.push_back({weights[slot] * row.normal, nodes.node(slot), slot});
            }
          if (row.levered)
            for (const std::size_t end = s + row.n_lever; s < end; ++s)
              entries.push_back({on_normals[s], nodes.node(s), static_cast<unsigned int>(s)});
        }
    acting.push_back({0, entries.size(), 0., 0., 0., 0., 0., 0.});
  }



  template <class Value>
  void
  ImpulseSolver::sum_entries(const Value &of_entry)
  {
    std::fill(sums.begin(), sums.end(), Tensor<1, dim>());
    const bool alone = nodes.alone();
    for (std::size_t i = 0; i + 1 < acting.size(); ++i)
      for (std::size_t e = acting[i].first; e < acting[i + 1].first; ++e)
        {
          const Tensor<1, dim> value = of_entry(acting[i], entries[e]);
          sums[entries[e].node] += value;
          if (!alone)
            at_slots[entries[e].slot] = value;
        }
    if (!alone)
      nodes.sum_shared(at_slots, sums);
  }



  // The bound of ImpulseSolver::set_metric() with the size of what a row does to a node.
  void
  ImpulseSolver::set_normal_metric(const double relaxation)
  {
    sum_entries([](const NormalRow &, const NormalEntry &entry) {
      Tensor<1, dim> size;
      size[0] = entry.c.norm();
      return size;
    });
    nodes.forward(sums);
    for (std::size_t i = 0; i + 1 < acting.size(); ++i)
      {
        double along = 0., whole = 0.;
        for (std::size_t e = acting[i].first; e < acting[i + 1].first; ++e)
          if (const double size = entries[e].c.norm(); size > 0.)
            {
              const auto  &m    = mobility[entries[e].node];
              const double part = sums[entries[e].node][0];
              along += part / size * (entries[e].c * (m * entries[e].c));
              whole += part * size * m.norm();
            }
        acting[i].mobility           = along > immobile * whole ? along / relaxation : 0.;
        metric[acting[i].row]        = Metric();
        metric[acting[i].row].normal = acting[i].mobility;
      }
  }



  void
  ImpulseSolver::apply_normal(double NormalRow::*const impulse)
  {
    sum_entries(
      [impulse](const NormalRow &row, const NormalEntry &entry) { return row.*impulse * entry.c; });
    for (unsigned int node = 0; node < nodes.n_owned(); ++node)
      velocity[node] = free[node] + mobility[node] * sums[node];
    nodes.forward(velocity);
  }



  void
  ImpulseSolver::put_impulses()
  {
    for (std::size_t i = 0; i + 1 < acting.size(); ++i)
      {
        ImpulseRow &row = rows[acting[i].row];
        row.impulse     = acting[i].impulse * row.normal;
        row.blocked     = !(acting[i].mobility > 0.);
      }
  }



  void
  ImpulseSolver::take_impulses()
  {
    for (NormalRow &row : acting)
      row.impulse = row.extrapolated = row.present =
        rows.empty() ? 0. : rows[row.row].impulse * rows[row.row].normal;
  }



  bool
  ImpulseSolver::sweep_normal(const ImpulseControl &control,
                              const double          tolerance,
                              ImpulseCounts        &counts)
  {
    double       momentum = 1.;
    unsigned int until    = first_exploration;
    while (counts.sweeps < control.sweeps)
      {
        if (control.accelerate && until-- == 0)
          {
            put_impulses();
            explore_face(control, tolerance, counts);
            take_impulses();
            momentum = 1.;
            until    = between_explorations;
          }
        ++counts.sweeps;
        apply_normal(&NormalRow::extrapolated);
        double   change = 0.;
        ExactSum turn;
        for (std::size_t i = 0; i + 1 < acting.size(); ++i)
          {
            NormalRow &row    = acting[i];
            double     excess = row.allowed - row.drive;
            for (std::size_t e = row.first; e < acting[i + 1].first; ++e)
              excess += entries[e].c * velocity[entries[e].node];
            row.impulse =
              row.mobility > 0. ? std::max(0., row.extrapolated - excess / row.mobility) : 0.;
            const double step = row.impulse - row.extrapolated;
            change            = std::max(change, row.mobility * std::abs(step));
            turn.add(-row.mobility * step * (row.impulse - row.present));
          }
        change = Utilities::MPI::max(change, nodes.communicator());
        // As of sweeps over rows of all kinds: momentum that points uphill is dropped.
        const bool done = change <= tolerance;
        if (done || control.one_sweep)
          {
            put_impulses();
            return done;
          }
        const bool   uphill = !control.accelerate || turn.value(nodes.communicator()) > 0.;
        const double next   = uphill ? 1. : 0.5 * (1. + std::sqrt(1. + 4. * momentum * momentum));
        const double beta   = uphill ? 0. : (momentum - 1.) / next;
        momentum            = next;
        for (NormalRow &row : acting)
          {
            row.extrapolated = row.impulse + beta * (row.impulse - row.present);
            row.present      = row.impulse;
          }
      }
    put_impulses();
    return false;
  }
} // namespace Touchstone
