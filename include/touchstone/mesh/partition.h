// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_partition_h
#define touchstone_mesh_partition_h

#include <touchstone/base/types.h>
#include <touchstone/mesh/geometry.h>

#include <deal.II/distributed/tria_base.h>

#include <functional>
#include <memory>

/**
 * @file
 * How the cells of the forest are distributed over the ranks.
 */

namespace Touchstone
{
  /**
   * @brief The work of a cell, in whole numbers.
   *
   * By itself: 1, and 3 if it is integrated anew in each Newton iteration and others
   * are not (measured on prm/plate_drop.prm: 2 with MUMPS, 6 with Belos CG). For contact:
   * see ContactWork.
   */
  using CellWork = std::function<unsigned int(const dealii::Triangulation<dim>::cell_iterator &)>;

  /** @brief The mesh on one rank, which is not distributed. It cannot be refined
   * later. */
  std::unique_ptr<dealii::parallel::TriangulationBase<dim>>
  whole_mesh(const BodyMesh &mesh, unsigned int refinements, MPI_Comm communicator);

  /** @brief The mesh in as many pieces of p4est's space-filling curve as there are
   * ranks, of about the same sum of weights if it is @p weighted: the work of each cell,
   * and @p contact_weight for each of its slave faces. The weights stay: later refinement
   * respects them. */
  std::unique_ptr<dealii::parallel::TriangulationBase<dim>>
  partition_by_curve(const BodyMesh &mesh,
                     unsigned int    refinements,
                     const CellWork &cell_work,
                     const CellWork &contact_work,
                     bool            weighted,
                     double          contact_weight,
                     MPI_Comm        communicator);

  /**
   * @brief The same mesh in the pieces that METIS makes of its graph of cells and
   * faces: few faces between pieces, and each piece has its share of the cells' work and,
   * if @p balance_contact, its share of the contact work as well.
   *
   * Two constraints of one k-way partition: Karypis and Kumar (1998), Multilevel
   * algorithms for multi-constraint graph partitioning, SC98. The first rank makes
   * the whole refined mesh and its partition, and sends the parts to the others; the result cannot
   * be refined later. Collective.
   * @throws std::runtime_error if METIS fails, on all ranks.
   */
  std::unique_ptr<dealii::parallel::TriangulationBase<dim>>
  partition_by_graph(const BodyMesh &mesh,
                     unsigned int    refinements,
                     const CellWork &cell_work,
                     const CellWork &contact_work,
                     bool            balance_contact,
                     MPI_Comm        communicator);

  /**
   * @brief The same mesh cut across its longest side into two pieces of about the same work,
   * these again, and so on: bodies that lie in each other share ranks where they touch, so
   * that contact needs little communication.
   *
   * Work as for partition_by_curve(). If the mesh @p computes_ghosts (ForestInput), the lower piece
   * is smaller by the cells of the other one that it computes as well. Coarse cells are distributed
   * where there are many of them, and each rank refines only its own and those around; refined ones
   * where there are few, and each rank makes all. The result cannot be refined later. Needs no
   * messages; collective. Berger and Bokhari (1987), IEEE Trans. Comput. C-36.
   */
  std::unique_ptr<dealii::parallel::TriangulationBase<dim>>
  partition_by_coordinates(const BodyMesh &mesh,
                           unsigned int    refinements,
                           const CellWork &cell_work,
                           const CellWork &contact_work,
                           double          contact_weight,
                           bool            computes_ghosts,
                           MPI_Comm        communicator);
} // namespace Touchstone

#endif
