// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_conflicting_supports_h
#define touchstone_solid_conflicting_supports_h

#include <touchstone/solid/boundary_conditions.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief Refuse supports that contradict each other at a node: a displacement that is prescribed
   * where boundaries meet, along directions in which 'Fixed', 'Symmetry' or another boundary of the
   * body prescribe another one. Only one of them could be kept, and nobody would be told.
   *
   * Values count as equal to a millionth of the largest displacement prescribed at that time.
   *
   * @param times At which formulas are evaluated, the ends of steps for example; time 0 as well.
   * Collective.
   * @throws InputError on all ranks, with formula, place and time; also if a formula is not finite.
   */
  void
  check_supports(const BoundaryConditions  &conditions,
                 const std::vector<double> &times,
                 MPI_Comm                   communicator);
} // namespace Touchstone

#endif
