// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_nodal_value_h
#define touchstone_algebra_nodal_value_h

#include <touchstone/algebra/vector.h>
#include <touchstone/base/types.h>

#include <deal.II/base/tensor.h>

namespace Touchstone
{
  /** @brief The vector that a field has at a node, of this rank or among its ghosts. */
  inline dealii::Tensor<1, dim>
  nodal_value(const Vector &field, const Index node)
  {
    dealii::Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = field(dim * node + d);
    return result;
  }
} // namespace Touchstone

#endif
