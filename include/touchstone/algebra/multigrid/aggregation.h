// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_multigrid_aggregation_h
#define touchstone_algebra_multigrid_aggregation_h

#include <vector>

namespace Touchstone
{
  /** @brief Couplings weaker than this, over the diagonal, do not count for aggregates. */
  constexpr double weak_coupling = 0.003;

  /** @brief Groups of nodes; each becomes one unit of the next coarser level of multigrid. */
  struct Aggregates
  {
    /** By node, counted from 0; -1: none. */
    std::vector<int> of_node;
    int              n = 0;
  };

  /**
   * @brief Aggregates of nodes that are coupled and of the same body.
   *
   * An aggregate across a contact surface could not represent that bodies slide on each
   * other, for it has but the rigid motions of both together; conjugate gradients then
   * took twice the iterations and the more, the finer the mesh.
   * Vanek, Mandel and Brezina (1996), Computing 56, algorithm 5.1.
   *
   * @param graph The nodes to which each is coupled, without itself.
   * @param body  Body of each node.
   */
  Aggregates
  aggregate(std::vector<std::vector<int>> graph, const std::vector<unsigned int> &body);
} // namespace Touchstone

#endif
