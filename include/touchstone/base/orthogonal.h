// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_orthogonal_h
#define touchstone_base_orthogonal_h

#include <touchstone/base/types.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace Touchstone
{
  /** @brief What is left of a vector across some directions: v - sum (v.e) e, one after the other.
   * @param directions Orthonormal. */
  inline dealii::Tensor<1, dim>
  orthogonal_part(dealii::Tensor<1, dim>                     vector,
                  const std::vector<dealii::Tensor<1, dim>> &directions)
  {
    for (const dealii::Tensor<1, dim> &direction : directions)
      vector -= (vector * direction) * direction;
    return vector;
  }
} // namespace Touchstone

#endif
