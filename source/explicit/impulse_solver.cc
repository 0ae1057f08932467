// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/impulse_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

// The sweeps over the contact rows of a cycle (doc/explicit.md, sections 9.2 and 9.3): a proximal
// gradient method on the dual problem in the impulses. All rows move at once, so that no order of
// rows and no colouring is needed and the result is the same for any partition.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A mobility below this part of all that of the nodes of a row is round-off: supports decide
     * along that direction. */
    constexpr double immobile = 1e-10;

    /** The tangential force is on the cone up to round-off of the sweeps. */
    constexpr double on_the_cone = 1. - 1e-9;

    /** Two unit vectors that are perpendicular to a unit vector and to each other. */
    std::array<Tensor<1, dim>, 2>
    plane_of(const Tensor<1, dim> &normal)
    {
      // The axis that is farthest from the normal.
      unsigned int axis = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (std::abs(normal[d]) < std::abs(normal[axis]))
          axis = d;
      Tensor<1, dim> e;
      e[axis] = 1.;
      e -= normal[axis] * normal;
      e /= e.norm();
      return {{e, cross_product_3d(normal, e)}};
    }
  } // namespace



  ImpulseSolver::ImpulseSolver(const MPI_Comm communicator)
    : nodes(communicator)
  {
  }



  void
  ImpulseSolver::resize()
  {
    weights.assign(nodes.n_slots(), 0.);
    levers.assign(nodes.n_slots(), Tensor<2, dim>());
    at_slots.assign(nodes.n_slots(), Tensor<1, dim>());
    order.resize(nodes.n_slots());
    std::iota(order.begin(), order.end(), 0);
    mobility.resize(nodes.n());
    velocity.resize(nodes.n());
    sums.resize(nodes.n());
    free.resize(nodes.n());
    metric.resize(rows.size());
    active.resize(rows.size());
    extrapolated.resize(rows.size());
    present.resize(rows.size());
  }



  Tensor<1, dim>
  ImpulseSolver::relative_velocity(const ImpulseRow                  &row,
                                   const std::vector<Tensor<1, dim>> &v) const
  {
    Tensor<1, dim> w;
    std::size_t    s = row.first;
    for (const std::size_t end = s + row.n_nodes; s < end; ++s)
      w += weights[order[s]] * v[nodes.node(order[s])];
    if (row.levered)
      for (const std::size_t end = s + row.n_lever; s < end; ++s)
        w += v[nodes.node(s)] * levers[s]; // transposed
    return w - row.drive;
  }



  // The impulses act with the coefficients that measure the relative velocity, A^T, so that what
  // the slave side gets the master side loses, and a common rigid motion gets nothing.
  void
  ImpulseSolver::apply(const std::vector<Tensor<1, dim>> &impulses)
  {
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (active[k])
        {
          const ImpulseRow &row = rows[k];
          std::size_t       s   = row.first;
          for (const std::size_t end = s + row.n_nodes; s < end; ++s)
            at_slots[s] = weights[s] * impulses[k];
          if (row.levered)
            for (const std::size_t end = s + row.n_lever; s < end; ++s)
              at_slots[s] = levers[s] * impulses[k];
        }
    nodes.sum(at_slots, sums);
    for (unsigned int node = 0; node < nodes.n_owned(); ++node)
      velocity[node] = free[node] + mobility[node] * sums[node];
    nodes.forward(velocity);
  }



  // Rows that share a node share its mobility. With s = sum_j alpha_j over the rows of the node,
  // |sum_j x_j|^2 <= sum_j (s / alpha_j) |x_j|^2, so the mobility of a row counts s / alpha times:
  // a bound of the coupled problem that is exact where no node is shared.
  void
  ImpulseSolver::set_metric()
  {
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (active[k])
        {
          const ImpulseRow &row = rows[k];
          std::size_t       s   = row.first;
          for (const std::size_t end = s + row.n_nodes; s < end; ++s)
            at_slots[s][0] = std::abs(weights[s]);
          if (row.levered)
            for (const std::size_t end = s + row.n_lever; s < end; ++s)
              at_slots[s][0] = levers[s].norm();
        }
    nodes.sum(at_slots, sums);
    nodes.forward(sums);
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (active[k])
        metric[k] = metric_of(rows[k]);
  }



  ImpulseSolver::Metric
  ImpulseSolver::metric_of(const ImpulseRow &row) const
  {
    SymmetricTensor<2, dim> d;
    double                  whole = 0.;
    std::size_t             s     = row.first;
    for (const std::size_t end = s + row.n_nodes; s < end; ++s)
      {
        const unsigned int node = nodes.node(order[s]);
        const double       part = sums[node][0] * std::abs(weights[order[s]]);
        d += part * mobility[node];
        whole += part * mobility[node].norm();
      }
    if (row.levered)
      for (const std::size_t end = s + row.n_lever; s < end; ++s)
        if (const double size = levers[s].norm(); size > 0.)
          {
            const unsigned int node = nodes.node(s);
            d += sums[node][0] / size *
                 symmetrize(transpose(levers[s]) * Tensor<2, dim>(mobility[node]) * levers[s]);
          }
    Metric result;
    // Normal and tangential directions are moved separately: what couples them is added to both.
    const Tensor<1, dim> by_normal = d * row.normal;
    const double         coupled   = (row.tangential * by_normal).norm();
    result.normal                  = row.normal * by_normal;
    if (row.friction)
      {
        const auto   e  = plane_of(row.normal);
        const auto   t0 = row.tangential * e[0], t1 = row.tangential * e[1];
        const double a = t0 * (d * t0), b = t0 * (d * t1), c = t1 * (d * t1);
        result.tangential = 0.5 * (a + c) + std::hypot(0.5 * (a - c), b) + coupled;
        if (result.normal > immobile * whole)
          result.normal += coupled;
      }
    if (!(result.normal > immobile * whole))
      result.normal = 0.;
    if (!(result.tangential > immobile * whole))
      result.tangential = 0.;
    for (unsigned int i = 0; i < dim; ++i)
      if (d[i][i] > immobile * whole)
        for (unsigned int j = 0; j < dim; ++j)
          result.tied[i] += std::abs(d[i][j]);
    return result;
  }



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
    if (!row.friction || p_n == 0. || !(m.tangential > 0.))
      return normal;

    const Tensor<1, dim> trial = row.tangential * (from - w / m.tangential);
    const double         size  = trial.norm();
    const double         slip  = (row.tangential * w).norm();
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
    double radius = limit(row.sliding);
    if (!row.sliding && size > radius)
      {
        // It begins to slip; whether it comes to rest is for the next cycle.
        row.sliding = true;
        radius      = limit(true);
      }
    return size > radius ? normal + (radius / size) * trial : normal + trial;
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
    for (std::size_t k = 0; k < rows.size(); ++k)
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
    for (std::size_t k = 0; k < rows.size(); ++k)
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
    for (std::size_t k = 0; k < rows.size(); ++k)
      extrapolated[k] = present[k] = active[k] ? rows[k].impulse : Tensor<1, dim>();
    double momentum = 1.;
    while (counts.sweeps < control.sweeps)
      {
        ++counts.sweeps;
        apply(extrapolated);
        double   change = 0.;
        ExactSum turn;
        for (std::size_t k = 0; k < rows.size(); ++k)
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
        for (std::size_t k = 0; k < rows.size(); ++k)
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
    for (std::size_t k = 0; k < rows.size(); ++k)
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
    for (ImpulseRow &row : rows)
      row.impulse *= alpha;
    for (std::size_t k = 0; k < rows.size(); ++k)
      present[k] = rows[k].impulse;
    apply(present);
    for (ImpulseRow &row : rows)
      row.velocity = relative_velocity(row);
  }



  // The order of slots within a row can depend on the numbering of nodes, and sums over them must
  // not.
  void
  ImpulseSolver::sort_slots(const std::vector<std::uint64_t> &keys)
  {
    for (const ImpulseRow &row : rows)
      std::sort(order.begin() + row.first,
                order.begin() + row.first + row.n_nodes,
                [&](const std::size_t a, const std::size_t b) {
                  return keys[nodes.node(a)] < keys[nodes.node(b)];
                });
  }



  ImpulseCounts
  ImpulseSolver::solve(const ImpulseControl &control)
  {
    ImpulseCounts counts;
    free = velocity;
    for (std::size_t k = 0; k < rows.size(); ++k)
      {
        ImpulseRow &row   = rows[k];
        row.free_velocity = row.velocity = row.distant ? Tensor<1, dim>() : relative_velocity(row);
        row.blocked                      = false;
        if (control.one_sweep)
          row.impulse = Tensor<1, dim>();
        active[k] = row.tied || row.impulse.norm_square() > 0.;
      }
    const int warm = std::find(active.begin(), active.end(), true) != active.end();
    bool      more = activate(0.);
    more           = Utilities::MPI::max(warm, nodes.communicator()) > 0 || more;
    if (more)
      std::fill(at_slots.begin(), at_slots.end(), Tensor<1, dim>());
    while (more)
      {
        ++counts.rounds;
        const double tolerance = velocity_tolerance(control.tolerance);
        set_metric();
        if (control.relaxation != 1.)
          for (Metric &m : metric)
            {
              m.normal /= control.relaxation;
              m.tangential /= control.relaxation;
              m.tied /= control.relaxation;
            }
        counts.converged = sweep(control, tolerance, counts);
        for (std::size_t k = 0; k < rows.size(); ++k)
          present[k] = rows[k].impulse;
        apply(present);
        for (ImpulseRow &row : rows)
          row.velocity = relative_velocity(row);
        more = !control.one_sweep && counts.sweeps < control.sweeps && activate(tolerance);
      }
    if (counts.rounds > 0 && !counts.converged && !control.one_sweep)
      restrain();
    for (std::size_t k = 0; k < rows.size(); ++k)
      {
        ImpulseRow &row = rows[k];
        if (!active[k])
          row.impulse = Tensor<1, dim>();
        counts.active += active[k];
        const double p_n = row.impulse * row.normal;
        if (row.friction && row.sliding)
          {
            // At rest within the cone: it sticks from the next cycle on.
            FrictionInput input;
            input.normal_force  = p_n / control.step;
            input.area          = row.area;
            input.slip_length   = row.slip_length;
            input.time          = control.time;
            input.sliding       = true;
            const double radius = row.friction->law->limit(input).force * control.step;
            row.sliding = p_n > 0. && (row.tangential * row.impulse).norm() >= on_the_cone * radius;
          }
      }
    return counts;
  }



  ImpulseCounts
  ImpulseSolver::apply_given()
  {
    ImpulseCounts counts;
    free = velocity;
    std::fill(at_slots.begin(), at_slots.end(), Tensor<1, dim>());
    for (std::size_t k = 0; k < rows.size(); ++k)
      {
        ImpulseRow &row   = rows[k];
        row.free_velocity = row.velocity = relative_velocity(row);
        row.blocked                      = false;
        active[k]                        = row.impulse.norm_square() > 0.;
        present[k]                       = row.impulse;
        counts.active += active[k];
      }
    const int some = counts.active > 0;
    if (Utilities::MPI::max(some, nodes.communicator()) == 0)
      return counts;
    counts.rounds = 1;
    apply(present);
    for (ImpulseRow &row : rows)
      row.velocity = relative_velocity(row);
    return counts;
  }



  std::vector<std::array<double, 2>>
  ImpulseSolver::mobilities()
  {
    std::fill(at_slots.begin(), at_slots.end(), Tensor<1, dim>());
    std::fill(active.begin(), active.end(), true);
    set_metric();
    std::vector<std::array<double, 2>> result(rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      {
        const Metric &m = metric[k];
        result[k]       = {
                {rows[k].tied ? std::max({m.tied[0], m.tied[1], m.tied[2]}) : m.normal, m.tangential}};
      }
    return result;
  }
} // namespace Touchstone
