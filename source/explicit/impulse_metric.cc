// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/impulse_solver.h>

#include <algorithm>
#include <cmath>
#include <numeric>

// Bounds of the mobility that contact rows share (doc/explicit.md, section 9.2, equation (3)), by
// which sweeps move all rows at once.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
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



  // Rows that share a node share its mobility. With s = sum_j alpha_j over the rows of the node,
  // |sum_j x_j|^2 <= sum_j (s / alpha_j) |x_j|^2, so the mobility of a row counts s / alpha times:
  // a bound of the coupled problem that is exact where no node is shared.
  void
  ImpulseSolver::set_metric()
  {
    for (const std::size_t k : near)
      if (active[k])
        {
          const ImpulseRow &row = rows[k];
          std::size_t       s   = row.first;
          for (const std::size_t end = s + row.n_nodes; s < end; ++s)
            at_slots[s][0] = std::abs(weights[s]);
          if (row.levered)
            for (const std::size_t end = s + row.n_lever; s < end; ++s)
              at_slots[s][0] = row.along_normal ? on_normals[s].norm() : levers[s].norm();
        }
    nodes.sum(at_slots, sums);
    nodes.forward(sums);
    for (const std::size_t k : near)
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
    if (row.levered && row.along_normal)
      {
        double levered = 0.;
        for (const std::size_t end = s + row.n_lever; s < end; ++s)
          if (const double size = on_normals[s].norm(); size > 0.)
            levered += sums[nodes.node(s)][0] / size *
                       (on_normals[s] * (mobility[nodes.node(s)] * on_normals[s]));
        d += levered * symmetrize(outer_product(row.normal, row.normal));
      }
    else if (row.levered)
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



  std::vector<std::array<double, 2>>
  ImpulseSolver::mobilities()
  {
    std::fill(at_slots.begin(), at_slots.end(), Tensor<1, dim>());
    std::fill(active.begin(), active.end(), true);
    near.resize(rows.size());
    std::iota(near.begin(), near.end(), 0);
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
