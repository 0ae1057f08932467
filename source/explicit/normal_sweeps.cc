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
    normal_rows.clear();
    const bool alone = nodes.alone();
    for (const std::size_t k : by_key)
      if (acts[k])
        {
          const ImpulseRow &row     = rows[k];
          const double      impulse = row.impulse * row.normal;
          normal_rows.rows.push_back({k,
                                      normal_rows.entries.size(),
                                      row.allowed * row.normal,
                                      row.drive * row.normal,
                                      0.,
                                      impulse,
                                      impulse,
                                      impulse});
          const auto add =
            [&](const Tensor<1, dim> &c, const double norm, const unsigned int slot) {
              normal_rows.add(c, norm, nodes.node(slot));
              if (!alone)
                normal_rows.slots.push_back(slot);
            };
          std::size_t s = row.first;
          for (const std::size_t end = s + row.n_nodes; s < end; ++s)
            add(weights[order[s]] * row.normal, std::abs(weights[order[s]]), order[s]);
          if (row.levered)
            for (const std::size_t end = s + row.n_lever; s < end; ++s)
              add(on_normals[s], on_normals[s].norm(), s);
        }
    normal_rows.rows.push_back({0, normal_rows.entries.size(), 0., 0., 0., 0., 0., 0.});
    normal_rows.set_nodes(free, mobility);
  }



  void
  ImpulseSolver::sum_shared_entries(double NormalRows::Row::*const impulse)
  {
    if (nodes.alone())
      return;
    for (unsigned int i = 0; i < normal_rows.size(); ++i)
      for (std::size_t e = normal_rows.rows[i].first; e < normal_rows.rows[i + 1].first; ++e)
        for (unsigned int d = 0; d < dim; ++d)
          at_slots[normal_rows.slots[e]][d] =
            normal_rows.rows[i].*impulse * normal_rows.entries[e].c[d];
    nodes.sum_shared(at_slots, sums);
    for (const unsigned int node : nodes.shared_nodes())
      for (unsigned int d = 0; d < dim; ++d)
        normal_rows.sums[node].c[d] = sums[node][d];
  }



  void
  ImpulseSolver::sum_shared_sizes()
  {
    if (nodes.alone())
      return;
    for (std::size_t e = 0; e < normal_rows.entries.size(); ++e)
      {
        at_slots[normal_rows.slots[e]]    = Tensor<1, dim>();
        at_slots[normal_rows.slots[e]][0] = normal_rows.entries[e].c[3];
      }
    for (unsigned int node = 0; node < nodes.n_owned(); ++node)
      sums[node][0] = normal_rows.sums[node].c[3];
    nodes.sum_shared(at_slots, sums);
    nodes.forward(sums);
    for (unsigned int node = 0; node < nodes.n(); ++node)
      normal_rows.sums[node].c[3] = sums[node][0];
  }



  // The bound of ImpulseSolver::set_metric() with the size of what a row does to a node.
  void
  ImpulseSolver::set_normal_metric(const double relaxation)
  {
    normal_rows.sum_sizes();
    sum_shared_sizes();
    normal_rows.set_bounds(immobile, relaxation);
    for (unsigned int i = 0; i < normal_rows.size(); ++i)
      {
        metric[normal_rows.rows[i].row]        = Metric();
        metric[normal_rows.rows[i].row].normal = normal_rows.rows[i].mobility;
      }
  }



  void
  ImpulseSolver::apply_normal(double NormalRows::Row::*const impulse)
  {
    normal_rows.sum(impulse);
    sum_shared_entries(impulse);
    normal_rows.move(nodes.n_owned());
    if (!nodes.alone())
      nodes.forward(normal_rows.velocity);
  }



  void
  ImpulseSolver::finish_normal()
  {
    apply_normal(&NormalRows::Row::impulse);
    for (unsigned int node = 0; node < nodes.n(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        {
          sums[node][d]     = normal_rows.sums[node].c[d];
          velocity[node][d] = normal_rows.velocity[node].c[d];
        }
    for (unsigned int i = 0; i < normal_rows.size(); ++i)
      {
        ImpulseRow &row = rows[normal_rows.rows[i].row];
        row.velocity = (normal_rows.relative_velocity(i) - normal_rows.rows[i].drive) * row.normal;
      }
  }



  void
  ImpulseSolver::put_impulses()
  {
    for (unsigned int i = 0; i < normal_rows.size(); ++i)
      {
        const NormalRows::Row &of  = normal_rows.rows[i];
        ImpulseRow            &row = rows[of.row];
        row.impulse                = of.impulse * row.normal;
        row.blocked                = !(of.mobility > 0.);
      }
  }



  bool
  ImpulseSolver::turned(const double (&largest)[2]) const
  {
    // A power of two, so that scaling does not round.
    const double bound = largest[0] * largest[1];
    if (!(bound > 0.) || !std::isfinite(bound))
      return false;
    int exponent;
    std::frexp(bound, &exponent);
    return Utilities::MPI::sum(normal_rows.turn(std::ldexp(1., exponent)), nodes.communicator()) >
           0;
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
            explore_normal_face(control, tolerance, counts);
            momentum = 1.;
            until    = between_explorations;
          }
        ++counts.sweeps;
        apply_normal(&NormalRows::Row::extrapolated);
        double here[2], largest[2];
        normal_rows.improve(here);
        Utilities::MPI::max(here, nodes.communicator(), largest);
        // As of sweeps over rows of all kinds: momentum that points uphill is dropped.
        const bool done = largest[0] <= tolerance;
        if (done || control.one_sweep)
          {
            put_impulses();
            return done;
          }
        const bool   uphill = !control.accelerate || turned(largest);
        const double next   = uphill ? 1. : 0.5 * (1. + std::sqrt(1. + 4. * momentum * momentum));
        normal_rows.extrapolate(uphill ? 0. : (momentum - 1.) / next);
        momentum = next;
      }
    put_impulses();
    return false;
  }
} // namespace Touchstone
