// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_enforcement_row_dependence_h
#define touchstone_contact_enforcement_row_dependence_h

#include <touchstone/base/types.h>
#include <touchstone/contact/row.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <set>
#include <utility>
#include <vector>

/**
 * @file
 * Which dofs contact rows determine, which dofs their conditions depend on, and where that closes a
 * cycle: a directed graph has the dofs as vertices and an edge from each dof that a row determines
 * to each dof that it determines it by; dofs in a strongly connected component of two or more
 * vertices depend on themselves (doc/theory.md 6, "Cyclic constraints").
 */

namespace Touchstone
{
  /** @brief The dofs of the slave node that the conditions of a row determine, and those that their
   * values depend on. */
  struct RowDependence
  {
    Index              slave;
    std::vector<Index> dofs, on;
    /** Reference position of the slave node. */
    dealii::Point<dim> reference;
  };

  /**
   * @brief What the conditions of a row determine and depend on.
   *
   * A row determines one dof of its node, along the largest component of its normal (that is not
   * always the one that elimination chooses, but rows that say the same depend on each other's in
   * any case: no largest component of a unit normal is below the threshold).
   * @param free The part of the normal that the slave node can move along.
   * @param own_body The stencil is of the body of the slave node.
   * @param fully A row that sticks or is tied determines all components of its node by all
   * components of the stencil.
   * @param threshold Smaller coefficients do not count.
   */
  RowDependence
  dependence(const ContactRow             &row,
             const dealii::Tensor<1, dim> &free,
             bool                          fully,
             double                        threshold,
             bool                          own_body);

  /** Directed edges between vertices with consecutive numbers. */
  using Edges = std::vector<std::pair<unsigned int, unsigned int>>;

  /** @brief Which vertices of a directed graph lie on a cycle of two or more. */
  std::vector<bool>
  on_cycles(unsigned int n_vertices, const Edges &edges);

  /** @brief Slave nodes with dofs that depend on themselves. */
  std::set<Index>
  in_cycles(const std::vector<RowDependence> &rows);

  /**
   * @brief Of rows of one pair and one body that are on cycles, the slave nodes of those that would
   * close one.
   *
   * Rows are kept one by one, in an order of reference positions: dropping all of them, as of a
   * later pair, would leave nothing that keeps the surfaces apart.
   */
  std::set<Index>
  closing_cycles(const std::vector<RowDependence> &kept, const std::vector<RowDependence> &of_pair);

  /** @brief Leave out what rows of a pair depend on at slave nodes of these rows, of any rank.
   * Collective. */
  void
  leave_out_own_slaves(std::vector<RowDependence> &mine,
                       const dealii::IndexSet     &owned,
                       MPI_Comm                    communicator);

  /**
   * @brief Leave out what lies on no cycle, as nothing that is determined leads on from it or to
   * it, and what lies on none without that, and so on.
   *
   * In at most twenty rounds: what all ranks get are rows on cycles and between them, and not all
   * rows. Each rank asks the owners of the dofs that its rows depend on. Collective.
   */
  void
  leave_out_ends(std::vector<RowDependence> &kept,
                 std::vector<RowDependence> &of_pair,
                 const dealii::IndexSet     &owned,
                 MPI_Comm                    communicator);

  /** @brief What rows depend on, of all ranks. Collective. */
  std::vector<RowDependence>
  gather(const std::vector<RowDependence> &mine, MPI_Comm communicator);
} // namespace Touchstone

#endif
