// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_strong_components_h
#define touchstone_algebra_strong_components_h

#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief The vertices of a directed graph in lists, those that a path leads to from each other
   * in one; ascending.
   * @param n     Vertices.
   * @param edges From, to. */
  std::vector<std::vector<unsigned int>>
  strong_components(unsigned int                                              n,
                    const std::vector<std::pair<unsigned int, unsigned int>> &edges);
} // namespace Touchstone

#endif
