// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/verification/edge_fit.h>

#include <cmath>

namespace Touchstone
{
  void
  EdgeFit::add(const double area, const double r, const double traction)
  {
    // A traction t = t0 sqrt(1 - r^2/a^2) is a straight line in the squares: t^2 = t0^2 (1 -
    // r^2/a^2). Sums of its least-squares fit, weighted with the areas of the nodes.
    const double r2 = r * r, t2 = traction * traction;
    sums[0] += area;
    sums[1] += area * r2;
    sums[2] += area * r2 * r2;
    sums[3] += area * t2;
    sums[4] += area * r2 * t2;
  }



  double
  EdgeFit::edge(const MPI_Comm communicator, const double fallback) const
  {
    std::array<double, 5> all;
    for (unsigned int i = 0; i < all.size(); ++i)
      all[i] = dealii::Utilities::MPI::sum(sums[i], communicator);
    const auto [weight, r2, r4, t2, r2t2] = all;

    // Normal equations of t^2 = constant + slope r^2; the edge is where the line vanishes
    // (doc/theory.md 10, "Hertz"). This resolves the radius better than counting active nodes,
    // whose number changes by whole rings.
    const double determinant = weight * r4 - r2 * r2;
    const double slope       = weight * r2t2 - r2 * t2;
    const double constant    = r4 * t2 - r2 * r2t2;
    if (determinant > 1e-12 * weight * r4 && slope < 0. && constant > 0.)
      return std::sqrt(-constant / slope);
    // Too few nodes, or a traction that does not fall towards the edge.
    return fallback;
  }
} // namespace Touchstone
