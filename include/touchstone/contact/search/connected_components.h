// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_search_connected_components_h
#define touchstone_contact_search_connected_components_h

#include <touchstone/contact/geometry/face.h>

#include <vector>

namespace Touchstone
{
  /** @brief The connected components of some faces, where faces with a common node are connected:
   * for each face the smallest index of a face of its component. */
  std::vector<unsigned int>
  connected_components(const std::vector<const Face *> &faces);

  /** @brief Whether all of some faces are connected. */
  bool
  is_connected(const std::vector<const Face *> &faces);
} // namespace Touchstone

#endif
