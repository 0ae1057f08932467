// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/verification/edge_fit.h>

#include <cmath>

namespace Touchstone
{
  void
  EdgeFit::add(const double area, const double r, const double traction)
  {
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

    const double determinant = weight * r4 - r2 * r2;
    const double slope       = weight * r2t2 - r2 * t2;
    const double constant    = r4 * t2 - r2 * r2t2;
    if (determinant > 1e-12 * weight * r4 && slope < 0. && constant > 0.)
      return std::sqrt(-constant / slope);
    return fallback;
  }
} // namespace Touchstone
