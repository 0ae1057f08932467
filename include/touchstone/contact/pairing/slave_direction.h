// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_slave_direction_h
#define touchstone_contact_pairing_slave_direction_h

#include <touchstone/contact/geometry/surface.h>

#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief A direction in which a slave node looks for the master: a mean of the normals of faces
   * around it (doc/theory.md 3.4). */
  struct SlaveDirection
  {
    /** Unit outward normal of the slave surface. */
    dealii::Tensor<1, dim> n;
    /** The faces, each with the local number of the node there. */
    std::vector<std::pair<const Face *, unsigned int>> faces;
  };

  /**
   * @brief The directions at an owned node of a surface, in its present position.
   *
   * One, the averaged normal, unless the node lies on a sharp edge: then the averaged normals of
   * the faces on either side of it as well, after that of all.
   */
  std::vector<SlaveDirection>
  slave_directions(const Surface &surface, Index node);

  /** @brief How a direction changes with the positions of nodes: d n / d x_a, per length, for each
   * node a of its faces, once. */
  std::vector<std::pair<Index, dealii::Tensor<2, dim>>>
  differentiate(const Surface &surface, const SlaveDirection &direction);
} // namespace Touchstone

#endif
