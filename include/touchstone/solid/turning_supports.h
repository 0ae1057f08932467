// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_turning_supports_h
#define touchstone_solid_turning_supports_h

#include <touchstone/solid/boundary_conditions.h>

namespace Touchstone
{
  /**
   * @brief How far prescribed displacements turn each body from one time to another, whole turns as
   * well: rotation vectors, degrees.
   *
   * Formulas are evaluated at sixteen times between, and the rotations of a boundary about its
   * centre that fit the motion from each to the next best are added; of several boundaries of a
   * body the one that turns most counts. Nodes count of which two components are prescribed.
   * Collective; the same on all ranks.
   * @throws InputError if a formula is not finite.
   */
  std::vector<dealii::Tensor<1, dim>>
  turns_of_supports(const Solid              &solid,
                    const BoundaryConditions &conditions,
                    double                    from,
                    double                    to);
} // namespace Touchstone

#endif
