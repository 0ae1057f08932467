// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_vector_h
#define touchstone_algebra_vector_h

#include <deal.II/lac/trilinos_vector.h>

namespace Touchstone
{
  /** @brief Distributed vector over the displacement dofs. */
  using Vector = dealii::TrilinosWrappers::MPI::Vector;
} // namespace Touchstone

#endif
