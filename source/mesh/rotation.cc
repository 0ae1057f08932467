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
} // namespace Touchstone
