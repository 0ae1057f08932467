// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_types_h
#define touchstone_base_types_h

#include <deal.II/base/types.h>

#include <limits>

namespace Touchstone
{
  /** @brief Contact mechanics in space: everything is three-dimensional. */
  constexpr int dim = 3;

  /** @brief Global number of a degree of freedom. */
  using Index = dealii::types::global_dof_index;

  /** @brief Stands for no degree of freedom, node or face. */
  constexpr Index invalid_index = std::numeric_limits<Index>::max();
} // namespace Touchstone

#endif
