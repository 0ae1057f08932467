// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_shared_faces_h
#define touchstone_contact_shared_faces_h

#include <touchstone/contact/contact_pair.h>

#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief For each pair, at the slave nodes of which it covers a part, how far other pairs cover
   * the rest: from 0 to 1 in the first component of the node, no unit (doc/theory.md 3.1, "Faces
   * that several pairs cover"). It is a function of the present positions alone. In the second
   * component, 1 for CoverOfNodes::keep_rows.
   *
   * @param pairs After an update.
   * @return One field of owned dofs for each pair, or nothing where there are no such nodes.
   * Collective.
   */
  std::vector<Vector>
  cover_by_other_pairs(const std::vector<std::unique_ptr<ContactPair>> &pairs, const Solid &solid);
} // namespace Touchstone

#endif
