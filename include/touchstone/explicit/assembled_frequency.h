// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_assembled_frequency_h
#define touchstone_explicit_assembled_frequency_h

#include <touchstone/explicit/node_map.h>

#include <functional>
#include <vector>

namespace Touchstone
{
  /**
   * @brief An upper bound of the squared largest frequency of all cells together, by Lanczos'
   * iteration on differences of internal forces (doc/explicit.md, section 4).
   *
   * The iteration approaches the frequency from below; 2 % are added, which the error exceeds with
   * a probability of less than 1e-10 over the start vectors (Kuczynski and Wozniakowski 1992). The
   * start vector is made of the keys of the nodes, and sums are exact: the same bits on any number
   * of ranks. Collective.
   * @param masses Of the local nodes.
   * @param u      Displacement, ghosts as well.
   * @param force  Sets the internal forces at owned nodes at a displacement with ghosts.
   * @param size   A length that displacements of the differences are small beside.
   */
  double
  assembled_square_frequency(const NodeMap                                       &map,
                             const std::vector<double>                           &masses,
                             const NodeField                                     &u,
                             const std::function<void(NodeField &, NodeField &)> &force,
                             double                                               size);
} // namespace Touchstone

#endif
