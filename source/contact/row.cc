// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/row.h>

namespace Touchstone
{
  using namespace dealii;

  // Bounds over a displacement by one face size: a normal that turns by 30 (radian), or weights
  // that change by 300, are valid for a thirtieth or less of a face, less than an increment often
  // is. The comparison is written such that NaN counts as steep.
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
