// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_near_ranks_h
#define touchstone_base_near_ranks_h

#include <touchstone/base/types.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief For each of some boxes of this rank, the ranks, itself included and in ascending order,
   * that have a box near it: all ranks that have one which meets it, and others only if the box
   * around those of their boxes that reach into the same cell of a grid does.
   *
   * The ranks meet at the cells of a grid over all boxes, each of which one rank keeps: who has
   * boxes there tells it, who asks is told by it (rendezvous; Plimpton, Hendrickson and Stewart
   * 2004, J. Parallel Distrib. Comput. 64, 266-276). So no rank holds anything of all others: with
   * surfaces that are spread evenly a rank sends and keeps what belongs to its own boxes, and
   * each box is held against those of the few ranks around it.
   *
   * @param boxes   Of this rank, to be found by others. What is not a number meets nothing.
   * @param wanted  Boxes of this rank that are to find.
   * @return ranks by box of @p wanted. Collective.
   */
  std::vector<std::vector<unsigned int>>
  near_ranks(const std::vector<dealii::BoundingBox<dim>> &boxes,
             const std::vector<dealii::BoundingBox<dim>> &wanted,
             MPI_Comm                                     communicator);
} // namespace Touchstone

#endif
