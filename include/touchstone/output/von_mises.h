// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_von_mises_h
#define touchstone_output_von_mises_h

#include <touchstone/base/types.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

namespace Touchstone
{
  /** @brief Equivalent stress of von Mises, sqrt(3/2) |dev sigma|; force per area. */
  inline double
  von_mises(const dealii::SymmetricTensor<2, dim> &stress)
  {
    return std::sqrt(1.5) * dealii::deviator(stress).norm();
  }
} // namespace Touchstone

#endif
