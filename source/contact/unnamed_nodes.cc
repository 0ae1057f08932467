// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/deformed_cells.h>
#include <touchstone/contact/unnamed_nodes.h>

#include <deal.II/base/geometry_info.h>

#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Call @p use with each vertex of a face of a cell at the boundary that is named, or is not:
     * its number in the cell and its first dof. */
    template <class Cell, class Use>
    void
    for_each_vertex(const Cell            &cell,
                    const NamedBoundaries &named,
                    const bool             is_named,
                    const Use             &use)
    {
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f) &&
            (named.count({cell->material_id(), cell->face(f)->boundary_id()}) > 0) == is_named)
          for (unsigned int k = 0; k < GeometryInfo<dim>::vertices_per_face; ++k)
            {
              const unsigned int v = GeometryInfo<dim>::face_to_cell_vertices(f, k);
              use(v, cell->vertex_dof_index(v, 0));
            }
    }
  } // namespace



  std::vector<UnnamedNode>
  unnamed_nodes(const Contact &contact, const NamedBoundaries &named, const Vector &u)
  {
    // Cells beside those of this rank have all other faces at its vertices.
    std::set<Index> done;
    const auto     &cells = contact.solid_model().dof_handler.active_cell_iterators();
    for (const auto &cell : cells)
      if (!cell->is_artificial() && cell->at_boundary())
        for_each_vertex(cell, named, /*is_named=*/true, [&](const unsigned int, const Index node) {
          done.insert(node);
        });

    std::vector<UnnamedNode> result;
    for (const auto &cell : cells)
      if (cell->is_locally_owned() && cell->at_boundary())
        {
          const auto   now  = deformed_vertices(cell, u);
          const double size = cell->diameter() / std::sqrt(double(dim));
          for_each_vertex(
            cell, named, /*is_named=*/false, [&](const unsigned int v, const Index node) {
              if (contact.planes_of_symmetry().count(node / dim) == 0 && done.insert(node).second)
                result.push_back({cell->material_id(), node, now[v], cell->vertex(v), size});
            });
        }
    return result;
  }
} // namespace Touchstone
