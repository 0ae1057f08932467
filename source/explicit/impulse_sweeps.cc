// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/impulse_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>

// The sweeps over the rows that take part in a cycle: which do, how each is improved, when sweeps
// end, and that they gain no energy (doc/explicit.md, section 9.2).
namespace Touchstone
{
  using namespace dealii;

  // The minimum of the bound in the impulse of one row: Coulomb's law with the radius of the new
  // normal impulse, so that friction opposes the slip at the end of the cycle and normal impulses
  // see no dilation.
  Tensor<1, dim>
  ImpulseSolver::improve(ImpulseRow           &row,
                         const Metric         &m,
                         const Tensor<1, dim> &from,
                         const ImpulseControl &control) const
  {
    const Tensor<1, dim> &w = row.velocity;
    if (row.tied)
      {
        Tensor<1, dim> p = from;
        for (unsigned int d = 0; d < dim; ++d)
          if (m.tied[d] > 0.)
            p[d] -= (w[d] + row.allowed[d]) / m.tied[d];
        return p;
      }
    const double excess = w * row.normal + row.allowed * row.normal;
    row.blocked         = !(m.normal > 0.);
    if (row.blocked)
      return Tensor<1, dim>();
    const double         p_n    = std::max(0., from * row.normal - excess / m.normal);
    const Tensor<1, dim> normal = p_n * row.normal;
    if (!row.friction || p_n == 0.)
      return normal;

    const Tensor<1, dim> along = row.tangential * w;
    const double         slip  = along.norm();
    const auto           limit = [&](const bool sliding) {
      FrictionInput input;
      input.normal_force = p_n / control.step;
      input.area         = row.area;
      input.slip_length  = row.slip_length + slip * control.step;
      input.slip_rate    = sliding ? slip : 0.;
      input.time         = control.time;
      input.sliding      = sliding;
      return row.friction->law->limit(input).force * control.step;
    };
    const bool           free  = m.tangential > 0.;
    const Tensor<1, dim> trial = row.tangential * (free ? from - w / m.tangential : from);
    const double         size  = trial.norm();
    // Where supports determine the motion of both sides nothing takes back a slip: any is sliding,
    // with the whole force of the cone, as in doc/theory.md 6.
    if (!free && slip > immobile * speed(row))
      {
        row.sliding = true;
        return normal - (limit(true) / slip) * along;
      }
    double radius = limit(row.sliding);
    if (!row.sliding && size > radius)
      {
        // It begins to slip; whether it comes to rest is for the next cycle.
        row.sliding = true;
        radius      = limit(true);
      }
    return size > radius ? normal + (radius / size) * trial : normal + trial;
  }



  double
  ImpulseSolver::speed(const ImpulseRow &row) const
  {
    double result = row.drive.norm();
    for (std::size_t s = row.first; s < row.first + row.n_nodes; ++s)
      result = std::max(result, velocity[nodes.node(s)].norm());
    return result;
  }



  /** By how much a row fails to obey contact, velocity; negative if it does. */
  double
  ImpulseSolver::violation(const ImpulseRow &row, const Tensor<1, dim> &w) const
  {
    return row.tied ? (w + row.allowed).norm() : -(w + row.allowed) * row.normal;
  }



  // Rows that obey contact without impulses take no part: they would make others share mobility
  // with them. Those that the impulses of others close are added, and none is removed within a
  // cycle.
  bool
  ImpulseSolver::activate(const double tolerance)
  {
    int more = 0;
    for (const std::size_t k : near)
      if (!active[k] && !rows[k].distant && violation(rows[k], rows[k].velocity) > tolerance)
        {
          active[k] = true;
          more      = 1;
        }
    return Utilities::MPI::max(more, nodes.communicator()) > 0;
  }



  double
  ImpulseSolver::velocity_tolerance(const double relative) const
  {
    // Closing speed, and the round-off of the velocities.
    double scale[2] = {0., 0.};
    for (const std::size_t k : near)
      if (active[k])
        {
          const ImpulseRow &row = rows[k];
          scale[0]              = std::max(scale[0], std::abs(violation(row, row.free_velocity)));
          if (row.friction)
            scale[0] = std::max(scale[0], (row.tangential * row.free_velocity).norm());
          for (std::size_t s = row.first; s < row.first + row.n_nodes; ++s)
            scale[1] = std::max(scale[1], free[nodes.node(s)].norm());
        }
    double largest[2];
    Utilities::MPI::max(scale, nodes.communicator(), largest);
    return std::max(relative * largest[0],
                    16. * std::numeric_limits<double>::epsilon() * largest[1]);
  }



  bool
  ImpulseSolver::sweep(const ImpulseControl &control, const double tolerance, ImpulseCounts &counts)
  {
    int rubs = 0;
    for (const std::size_t k : near)
      {
        extrapolated[k] = present[k] = active[k] ? rows[k].impulse : Tensor<1, dim>();
        rubs |= active[k] && rows[k].friction != nullptr;
      }
    const bool explores =
      control.accelerate && Utilities::MPI::max(rubs, nodes.communicator()) == 0;
    double       momentum = 1.;
    unsigned int until    = first_exploration;
    while (counts.sweeps < control.sweeps)
      {
        if (explores && until-- == 0)
          {
            explore_face(control, tolerance, counts);
            for (const std::size_t k : near)
              extrapolated[k] = present[k] = active[k] ? rows[k].impulse : Tensor<1, dim>();
            momentum = 1.;
            until    = between_explorations;
          }
        ++counts.sweeps;
        apply(extrapolated);
        double   change = 0.;
        ExactSum turn;
        for (const std::size_t k : near)
          if (active[k])
            {
              ImpulseRow &row               = rows[k];
              row.velocity                  = relative_velocity(row);
              const Tensor<1, dim> improved = improve(row, metric[k], extrapolated[k], control);
              const Tensor<1, dim> step     = improved - extrapolated[k];
              const double         d        = row.tied ? metric[k].tied.norm() / std::sqrt(1. * dim)
                                                       : std::max(metric[k].normal, metric[k].tangential);
              change                        = std::max(change, d * step.norm());
              // The gradient method of O'Donoghue and Candes (2015), Found. Comput. Math. 15:
              // momentum that points uphill is dropped.
              turn.add(-d * (step * (improved - present[k])));
              row.impulse = improved;
            }
        change          = Utilities::MPI::max(change, nodes.communicator());
        const bool done = change <= tolerance;
        if (done || control.one_sweep)
          return done;
        const bool   uphill = !control.accelerate || turn.value(nodes.communicator()) > 0.;
        const double next   = uphill ? 1. : 0.5 * (1. + std::sqrt(1. + 4. * momentum * momentum));
        const double beta   = uphill ? 0. : (momentum - 1.) / next;
        momentum            = next;
        for (const std::size_t k : near)
          if (active[k])
            {
              extrapolated[k] = rows[k].impulse + beta * (rows[k].impulse - present[k]);
              present[k]      = rows[k].impulse;
            }
      }
    return false;
  }



  // Sweeps that end early must not gain energy. The energy that impulses alpha p give, without what
  // overlaps demand, is alpha L + alpha^2 Q; with L < 0 and the largest alpha <= 1 that keeps it
  // from being positive the impulses stay within their cones.
  void
  ImpulseSolver::restrain()
  {
    ExactSum linear, quadratic;
    for (const std::size_t k : near)
      if (active[k])
        {
          const ImpulseRow &row = rows[k];
          const double      demanded =
            row.tied ? -(row.impulse * row.allowed)
                          : std::max(0., -row.allowed * row.normal) * (row.impulse * row.normal);
          linear.add(row.impulse * row.free_velocity - demanded);
          quadratic.add(0.5 * (row.impulse * (row.velocity - row.free_velocity)));
        }
    const double l = linear.value(nodes.communicator()), q = quadratic.value(nodes.communicator());
    if (l + q <= 0.)
      return;
    const double alpha = l < 0. && q > 0. ? std::min(1., -l / q) : 0.;
    clear_slots();
    for (const std::size_t k : near)
      rows[k].impulse *= alpha;
    for (const std::size_t k : near)
      present[k] = rows[k].impulse;
    apply(present);
    for (const std::size_t k : near)
      rows[k].velocity = relative_velocity(rows[k]);
  }
} // namespace Touchstone
