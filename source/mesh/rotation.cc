// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/rotation.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  // Quarters are exact, since a plane that is off by round-off would not be the plane that one has
  // asked for.
  Tensor<2, 3>
  rotation(const Tensor<1, 3> &axis, const double degrees)
  {
    const double quarters = degrees / 90.;
    double c = std::cos(degrees * numbers::PI / 180.), s = std::sin(degrees * numbers::PI / 180.);
    if (quarters == std::round(quarters))
      {
        c = std::round(c);
        s = std::round(s);
      }
    // Rodrigues' formula.
    Tensor<2, 3> result =
      c * Tensor<2, 3>(unit_symmetric_tensor<3>()) + (1. - c) * outer_product(axis, axis);
    for (unsigned int d = 0; d < 3; ++d)
      {
        const unsigned int e = (d + 1) % 3, f = (d + 2) % 3;
        result[e][d] += s * axis[f];
        result[d][e] -= s * axis[f];
      }
    return result;
  }



  Tensor<1, 3>
  rotation_vector(const Tensor<2, 3> &turn)
  {
    Tensor<1, 3> axis; // times twice the sine
    for (unsigned int d = 0; d < 3; ++d)
      axis[d] = turn[(d + 2) % 3][(d + 1) % 3] - turn[(d + 1) % 3][(d + 2) % 3];
    const double sine = 0.5 * axis.norm(), cosine = 0.5 * (trace(turn) - 1.);
    if (sine > 1e-7)
      return std::atan2(sine, cosine) / axis.norm() * axis;
    if (cosine > 0.)
      return 0.5 * axis;
    // Half a turn: turn + 1 is twice the axis times itself.
    unsigned int largest = 0;
    for (unsigned int d = 1; d < 3; ++d)
      if (turn[d][d] > turn[largest][largest])
        largest = d;
    Tensor<1, 3> along = turn[largest];
    along[largest] += 1.;
    return numbers::PI / along.norm() * along;
  }
} // namespace Touchstone
