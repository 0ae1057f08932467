// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_search_connected_components_h
#define touchstone_contact_search_connected_components_h

#include <touchstone/contact/geometry/face.h>

#include <vector>

namespace Touchstone
{
  /** @brief For each of some faces a number, which is the same for faces that are connected over
   * common nodes, directly or over others of these faces. */
  std::vector<unsigned int>
  connected_components(const std::vector<const Face *> &faces);

  /** @brief Whether all of some faces are connected. */
  bool
  is_connected(const std::vector<const Face *> &faces);
} // namespace Touchstone

#endif
