// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/impulse_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>

// Conjugate gradients on the face that sweeps have found: the impulses that press
// (doc/explicit.md, section 9.2). Sweeps find the face quickly but are slow on it where rows of
// general contact say nearly the same; this is what the method of More and Toraldo (1991), SIAM J.
// Optim. 1, alternates. For rows without friction: what slides is no minimum.
namespace Touchstone
{
  using namespace dealii;

  // What a row may change: the normal impulse, and of one that is tied all of it.
  Tensor<1, dim>
  ImpulseSolver::on_face(const ImpulseRow &row, const Tensor<1, dim> &vector) const
  {
    if (row.tied)
      return vector;
    if (row.blocked || !(row.impulse * row.normal > 0.))
      return Tensor<1, dim>();
    return (vector * row.normal) * row.normal;
  }



  // The residual over the mobility that the row shares.
  Tensor<1, dim>
  ImpulseSolver::preconditioned(const ImpulseRow     &row,
                                const Metric         &m,
                                const Tensor<1, dim> &residual) const
  {
    Tensor<1, dim> result;
    if (row.tied)
      {
        for (unsigned int d = 0; d < dim; ++d)
          if (m.tied[d] > 0.)
            result[d] = residual[d] / m.tied[d];
        return result;
      }
    return m.normal > 0. ? residual / m.normal : result;
  }



  // As long as it stays on the face and has not come to the minimum there.
  void
  ImpulseSolver::explore_face(const ImpulseControl &control,
                              const double          tolerance,
                              ImpulseCounts        &counts)
  {
    std::vector<Tensor<1, dim>> &direction = extrapolated, &residual = present;
    std::vector<Tensor<1, dim>> &scaled       = on_rows;
    const MPI_Comm               communicator = nodes.communicator();
    const auto                   dot          = [&](const auto &term) {
      ExactSum sum;
      for (const std::size_t k : near)
        if (active[k])
          sum.add(term(k));
      return sum.value(communicator);
    };
    clear_slots();
    for (const std::size_t k : near)
      direction[k] = active[k] ? rows[k].impulse : Tensor<1, dim>();
    apply(direction);
    for (const std::size_t k : near)
      if (active[k])
        {
          ImpulseRow &row = rows[k];
          row.velocity    = relative_velocity(row);
          residual[k]     = -1. * on_face(row, row.velocity + row.allowed);
          scaled[k]       = on_face(row, preconditioned(row, metric[k], residual[k]));
          direction[k]    = scaled[k];
        }
    double size = dot([&](const std::size_t k) { return residual[k] * scaled[k]; });
    for (unsigned int i = 0; i < control.sweeps && size > 0.; ++i)
      {
        ++counts.on_faces;
        apply(direction);
        for (const std::size_t k : near)
          if (active[k])
            rows[k].velocity = on_face(rows[k], relative_velocity(rows[k]) - rows[k].free_velocity);
        const double curvature =
          dot([&](const std::size_t k) { return direction[k] * rows[k].velocity; });
        if (!(curvature > 0.))
          return;
        const double step = size / curvature;
        double       most = std::numeric_limits<double>::max(), left = 0.;
        for (const std::size_t k : near)
          if (const double down = -(direction[k] * rows[k].normal);
              active[k] && !rows[k].tied && down > 0.)
            most = std::min(most, rows[k].impulse * rows[k].normal / down);
        most                 = Utilities::MPI::min(most, communicator);
        const double allowed = std::min(step, most);
        for (const std::size_t k : near)
          if (active[k])
            {
              rows[k].impulse += allowed * direction[k];
              residual[k] -= allowed * rows[k].velocity;
              left = std::max(left, residual[k].norm());
            }
        if (allowed < step)
          return; // at the edge of the face
        if (Utilities::MPI::max(left, communicator) <= 0.1 * tolerance)
          return;
        for (const std::size_t k : near)
          if (active[k])
            scaled[k] = on_face(rows[k], preconditioned(rows[k], metric[k], residual[k]));
        const double next = dot([&](const std::size_t k) { return residual[k] * scaled[k]; });
        for (const std::size_t k : near)
          if (active[k])
            direction[k] = scaled[k] + (next / size) * direction[k];
        size = next;
      }
  }
} // namespace Touchstone
