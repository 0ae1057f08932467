// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_slave_direction_h
#define touchstone_contact_pairing_slave_direction_h

#include <touchstone/contact/geometry/surface.h>

#include <vector>

namespace Touchstone
{
  /** @brief A direction in which a slave node looks for the master: a mean of the normals of faces
   * around it (doc/theory.md 3.4). */
  struct SlaveDirection
  {
    /** Unit outward normal of the slave surface. */
    dealii::Tensor<1, dim> n;
    /** Of these, for Surface::normal_derivative(). */
    std::vector<NormalShare> shares;
  };

  /**
   * @brief The directions at an owned node of a surface, in its present position.
   *
   * One, the averaged normal, unless the node lies on a sharp edge: then the averaged normals of
   * the faces on either side of it as well, after that of all.
   */
  std::vector<SlaveDirection>
  slave_directions(const Surface &surface, Index node);
} // namespace Touchstone

#endif
