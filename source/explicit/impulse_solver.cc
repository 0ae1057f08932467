// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/impulse_solver.h>

#include <algorithm>
#include <numeric>

// The contact rows of a cycle (doc/explicit.md, sections 9.2 and 9.3): a proximal gradient method
// on the dual problem in the impulses. All rows move at once, so that no order of rows and no
// colouring is needed and the result is the same for any partition. The sweeps are in
// impulse_sweeps.cc, the bounds of the mass that rows share in impulse_metric.cc.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The tangential force is on the cone up to round-off of the sweeps. */
    constexpr double on_the_cone = 1. - 1e-9;
  } // namespace



  ImpulseSolver::ImpulseSolver(const MPI_Comm communicator)
    : nodes(communicator)
  {
  }



  void
  ImpulseSolver::resize()
  {
    int others = 0;
    for (ImpulseRow &row : rows)
      {
        row.along_normal = !row.tied && row.friction == nullptr;
        others |= !row.along_normal;
      }
    along_normals = Utilities::MPI::max(others, nodes.communicator()) == 0;
    by_key.resize(along_normals ? rows.size() : 0);
    std::iota(by_key.begin(), by_key.end(), 0);
    std::sort(by_key.begin(), by_key.end(), [&](const std::size_t a, const std::size_t b) {
      return rows[a].key < rows[b].key;
    });
    weights.assign(nodes.n_slots(), 0.);
    levers.assign(others ? nodes.n_slots() : 0, Tensor<2, dim>());
    on_normals.assign(nodes.n_slots(), Tensor<1, dim>());
    at_slots.assign(nodes.n_slots(), Tensor<1, dim>());
    order.resize(nodes.n_slots());
    std::iota(order.begin(), order.end(), 0);
    mobility.resize(nodes.n());
    velocity.resize(nodes.n());
    sums.resize(nodes.n());
    free.resize(nodes.n());
    metric.resize(rows.size());
    near.resize(rows.size());
    std::iota(near.begin(), near.end(), 0);
    active.assign(rows.size(), 0);
    extrapolated.resize(rows.size());
    present.resize(rows.size());
    on_rows.resize(rows.size());
  }



  Tensor<1, dim>
  ImpulseSolver::relative_velocity(const ImpulseRow                  &row,
                                   const std::vector<Tensor<1, dim>> &v) const
  {
    Tensor<1, dim> w;
    std::size_t    s = row.first;
    for (const std::size_t end = s + row.n_nodes; s < end; ++s)
      w += weights[order[s]] * v[nodes.node(order[s])];
    if (row.along_normal)
      {
        double along = (w - row.drive) * row.normal;
        if (row.levered)
          for (const std::size_t end = s + row.n_lever; s < end; ++s)
            along += on_normals[s] * v[nodes.node(s)];
        return along * row.normal;
      }
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
    for (const std::size_t k : near)
      if (active[k])
        {
          const ImpulseRow &row = rows[k];
          std::size_t       s   = row.first;
          for (const std::size_t end = s + row.n_nodes; s < end; ++s)
            at_slots[s] = weights[s] * impulses[k];
          if (row.levered)
            {
              const double along = impulses[k] * row.normal;
              for (const std::size_t end = s + row.n_lever; s < end; ++s)
                at_slots[s] = row.along_normal ? along * on_normals[s] : levers[s] * impulses[k];
            }
        }
    nodes.sum(at_slots, sums);
    for (unsigned int node = 0; node < nodes.n_owned(); ++node)
      velocity[node] = free[node] + mobility[node] * sums[node];
    nodes.forward(velocity);
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
    free     = velocity;
    int warm = 0;
    for (const std::size_t k : near)
      {
        ImpulseRow &row   = rows[k];
        row.free_velocity = row.velocity = row.distant ? Tensor<1, dim>() : relative_velocity(row);
        row.blocked                      = false;
        if (control.one_sweep)
          row.impulse = Tensor<1, dim>();
        active[k] = row.tied || row.impulse.norm_square() > 0.;
        warm |= active[k];
      }
    bool more = activate(0.);
    more      = Utilities::MPI::max(warm, nodes.communicator()) > 0 || more;
    if (more && !(along_normals && nodes.alone()))
      clear_slots();
    while (more)
      {
        ++counts.rounds;
        const double tolerance = velocity_tolerance(control.tolerance);
        if (along_normals)
          {
            collect_acting();
            set_normal_metric(control.relaxation);
            counts.converged = sweep_normal(control, tolerance, counts);
            finish_normal();
          }
        else
          {
            set_metric();
            if (control.relaxation != 1.)
              for (Metric &m : metric)
                {
                  m.normal /= control.relaxation;
                  m.tangential /= control.relaxation;
                  m.tied /= control.relaxation;
                }
            counts.converged = sweep(control, tolerance, counts);
            for (const std::size_t k : near)
              present[k] = rows[k].impulse;
            apply(present);
          }
        for (const std::size_t k : near)
          if (!(along_normals && active[k]))
            rows[k].velocity = relative_velocity(rows[k]);
        more = !control.one_sweep && counts.sweeps < control.sweeps && activate(tolerance);
      }
    if (counts.rounds > 0 && !counts.converged && !control.one_sweep)
      restrain();
    for (const std::size_t k : near)
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
    for (const std::size_t k : near)
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
    for (const std::size_t k : near)
      rows[k].velocity = relative_velocity(rows[k]);
    return counts;
  }
} // namespace Touchstone
