// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_inverted_cells_h
#define touchstone_explicit_inverted_cells_h

#include <touchstone/explicit/explicit_cells.h>

namespace Touchstone
{
  /** @brief The first owned cell whose determinant of the Jacobian is not positive at one of its 8
   * points with the displacement @p u, ghosts as well. Linear bodies have forces whatever becomes
   * of their cells: only so is seen that corners have passed through each other. */
  CellPlace
  inverted_cell(const NodeMap &map, const NodeField &u);
} // namespace Touchstone

#endif
