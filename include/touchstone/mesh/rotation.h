// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_rotation_h
#define touchstone_mesh_rotation_h

#include <deal.II/base/tensor.h>

namespace Touchstone
{
  /** @brief A turn about a unit vector, counter-clockwise for one whom the axis points at; exact
   * for quarters. */
  dealii::Tensor<2, 3>
  rotation(const dealii::Tensor<1, 3> &axis, double degrees);

  /** @brief The vector along the axis of a turn whose length is its angle in radians, at most pi.
   */
  dealii::Tensor<1, 3>
  rotation_vector(const dealii::Tensor<2, 3> &turn);
} // namespace Touchstone

#endif
