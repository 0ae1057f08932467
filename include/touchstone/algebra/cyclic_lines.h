// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_cyclic_lines_h
#define touchstone_algebra_cyclic_lines_h

#include <touchstone/base/types.h>

#include <deal.II/lac/affine_constraints.h>

namespace Touchstone
{
  /**
   * @brief Lines that refer to each other in a cycle become lines of what all of them refer to
   * besides: deal.II substitutes lines into each other, which ends where they form chains.
   *
   * For the lines x = C x + E y + b of a strongly connected component, x = (I - C)^-1 (E y + b)
   * (doc/theory.md 6, "Cyclic constraints"). Of this rank; it must know all lines of a cycle.
   *
   * @param constraints Not closed. C must not have the eigenvalue one.
   */
  void
  resolve_cycles(dealii::AffineConstraints<double> &constraints);
} // namespace Touchstone

#endif
