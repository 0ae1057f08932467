// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/distributed_mesh.h>

#include <vector>

namespace Touchstone
{
  using namespace dealii;

  void
  DistributedMesh::refine_alike(const unsigned int n_times)
  {
    for (unsigned int n = 0; n < n_times; ++n)
      {
        // Uniform refinement needs no agreement between ranks, hence the function of the
        // serial class.
        set_all_refine_flags();
        dealii::Triangulation<dim>::execute_coarsening_and_refinement();
      }
    local_cell_relations.clear(); // of coarse cells

    // Of the coarse neighbours' cells only those that touch own ones are needed.
    std::vector<char> own(n_vertices());
    for (const auto &cell : active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int v : cell->vertex_indices())
          own[cell->vertex_index(v)] = 1;
    for (const auto &cell : active_cell_iterators())
      {
        bool any = false;
        for (const unsigned int v : cell->vertex_indices())
          any = any || own[cell->vertex_index(v)];
        if (!any)
          cell->set_subdomain_id(numbers::artificial_subdomain_id);
      }
    // The function of the base class takes those of this rank for all.
    const auto n_coarse_cells = number_cache.number_of_global_coarse_cells;
    parallel::TriangulationBase<dim>::update_number_cache();
    number_cache.number_of_global_coarse_cells = n_coarse_cells;
  }
} // namespace Touchstone
