// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_node_positions_h
#define touchstone_solid_node_positions_h

#include <touchstone/solid/solid.h>

namespace Touchstone
{
  /** @brief The reference coordinates of the nodes, by owned dof; length. Collective. */
  Vector
  node_positions(const Solid &solid);
} // namespace Touchstone

#endif
