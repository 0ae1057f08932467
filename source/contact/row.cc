// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/row.h>

namespace Touchstone
{
  using namespace dealii;

  bool
  changes_steeply(const ContactRow &row)
  {
    constexpr double     turns = 30., weights_change = 300.; // over a face
    const RowDerivative &d = *row.derivative;
    for (const Tensor<2, dim> &normal : d.normal)
      if (!(normal.norm() * row.size < turns))
        return true;
    for (const auto &weight : d.weights)
      for (const Tensor<1, dim> &change : weight)
        if (!(change.norm() * row.size < weights_change))
          return true;
    return false;
  }
} // namespace Touchstone
