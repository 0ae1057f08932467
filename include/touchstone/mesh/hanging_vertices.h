// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_hanging_vertices_h
#define touchstone_mesh_hanging_vertices_h

#include <touchstone/base/types.h>

#include <deal.II/distributed/tria.h>

namespace Touchstone
{
  /**
   * @brief From now on keep vertices that hang in the middle of an edge or face of a larger cell
   * there, where refinement has put them on the curved surface (doc/theory.md 11).
   *
   * The displacement at such a vertex is the mean of those of the vertices that it hangs between,
   * so that its position must be, or a body that turns as a whole would be strained. Acts whenever
   * the mesh has been refined, coarsened or repartitioned; while that is under way all vertices are
   * where the surface has them.
   * @param triangulation Of cells of degree 1: of higher degree larger cells are curved as well.
   */
  void
  keep_hanging_vertices(dealii::parallel::distributed::Triangulation<dim> &triangulation);
} // namespace Touchstone

#endif
