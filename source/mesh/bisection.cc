// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/body_mesh.h>
#include <touchstone/mesh/contact_work.h>
#include <touchstone/mesh/distributed_mesh.h>
#include <touchstone/mesh/partition.h>
#include <touchstone/mesh/recursive_bisection.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/tria_description.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

// Partition of meshes that never change by recursive bisection of the coordinates: parts are
// compact, which keeps the surfaces between ranks small, and balanced by the work of cells and
// contact faces. The result depends on the mesh alone. If there are enough coarse cells, only
// these are distributed and each rank refines its own part, so that no rank ever holds the
// refined mesh.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** With fewer coarse cells than this on each rank the refined ones are counted. */
    constexpr unsigned int enough = 64;



    /** The cells of a mesh with their work, that of @p contact_weight for each part of a contact
     * face.
     * @param ghosts If ranks compute their ghosts, gets the vertices that tell them; else null. */
    std::vector<RecursiveBisection::Item>
    items_of(const Triangulation<dim>         &mesh,
             const CellWork                   &cell_work,
             const CellWork                   &contact_work,
             const double                      contact_weight,
             RecursiveBisection::Ghosts *const ghosts)
    {
      std::vector<RecursiveBisection::Item> items;
      for (const auto &cell : mesh.active_cell_iterators())
        {
          items.push_back(
            {cell->center(),
             cell_work(cell) + contact_weight * contact_work(cell) / ContactWork::slave_face,
             cell->active_cell_index(),
             ghosts ? 0 : cell_work(cell)});
          if (ghosts)
            {
              ghosts->vertices.emplace_back();
              for (const unsigned int v : cell->vertex_indices())
                ghosts->vertices.back()[v] = cell->vertex_index(v);
            }
        }
      return items;
    }



    /** Which of the coarse cells share a vertex with those that are marked, or are marked. */
    void
    add_neighbours(const BodyMesh &mesh, std::vector<char> &marked)
    {
      std::vector<char> vertices(mesh.vertices.size());
      for (unsigned int c = 0; c < marked.size(); ++c)
        if (marked[c])
          for (const unsigned int v : mesh.cells[c].vertices)
            vertices[v] = 1;
      for (unsigned int c = 0; c < marked.size(); ++c)
        for (const unsigned int v : mesh.cells[c].vertices)
          if (vertices[v])
            marked[c] = 1;
    }



    /** The part of a mesh that consists of @p cells. A boundary face of the whole mesh is kept with
     * its id if one of the cells has it; faces are compared by their sorted vertices. Faces towards
     * cells that were left out have no entry, and become boundary faces without an id. */
    BodyMesh
    part_of(const BodyMesh &mesh, const std::vector<unsigned int> &cells)
    {
      using Face = std::array<unsigned int, 4>;
      BodyMesh                  part;
      std::vector<unsigned int> number(mesh.vertices.size(), numbers::invalid_unsigned_int);
      std::set<Face>            faces;
      for (const unsigned int c : cells)
        {
          const dealii::CellData<dim> &cell = mesh.cells[c];
          for (const unsigned int f : GeometryInfo<dim>::face_indices())
            {
              Face face;
              for (unsigned int v = 0; v < face.size(); ++v)
                face[v] = cell.vertices[GeometryInfo<dim>::face_to_cell_vertices(f, v)];
              std::sort(face.begin(), face.end());
              faces.insert(face);
            }
          part.cells.push_back(cell);
          for (unsigned int &v : part.cells.back().vertices)
            {
              if (number[v] == numbers::invalid_unsigned_int)
                {
                  number[v] = part.vertices.size();
                  part.vertices.push_back(mesh.vertices[v]);
                }
              v = number[v];
            }
        }
      for (const dealii::CellData<2> &quad : mesh.subcells.boundary_quads)
        {
          Face face;
          std::copy(quad.vertices.begin(), quad.vertices.end(), face.begin());
          std::sort(face.begin(), face.end());
          if (faces.count(face) == 0)
            continue;
          part.subcells.boundary_quads.push_back(quad);
          for (unsigned int &v : part.subcells.boundary_quads.back().vertices)
            v = number[v];
        }
      part.manifolds = mesh.manifolds;
      return part;
    }
  } // namespace



  std::unique_ptr<parallel::TriangulationBase<dim>>
  partition_by_coordinates(const BodyMesh    &mesh,
                           const unsigned int refinements,
                           const CellWork    &cell_work,
                           const CellWork    &contact_work,
                           const double       contact_weight,
                           const bool         computes_ghosts,
                           const MPI_Comm     communicator)
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator),
                       here    = Utilities::MPI::this_mpi_process(communicator);
    constexpr auto smoothing   = Triangulation<dim>::limit_level_difference_at_vertices;
    // Each rank finds the ranks of its own items and of those around, without a message: it cuts
    // what its own are in, and sorts twice as many items as there are instead of all at each cut.
    Triangulation<dim> whole(smoothing);
    create_triangulation(mesh, whole);
    const bool coarse_cells = whole.n_active_cells() >= enough * n_ranks;
    if (!coarse_cells)
      whole.refine_global(refinements);
    // If a coarse cell stands for 8^r refined ones, each of its faces stands for 4^r: per unit of
    // cell work a contact face counts by 4^r / 8^r = 2^-r.
    const double               faces_of_cell = coarse_cells ? std::pow(0.5, refinements) : 1.;
    RecursiveBisection::Ghosts ghosts;
    ghosts.part = faces_of_cell; // one of 2^r layers of refined cells
    std::vector<RecursiveBisection::Item> items = items_of(whole,
                                                           cell_work,
                                                           contact_work,
                                                           faces_of_cell * contact_weight,
                                                           computes_ghosts ? &ghosts : nullptr);
    // Of coarse cells a second layer of neighbours is needed for the first one to know which of its
    // faces are at the boundary of the body; a refined mesh is described as a whole.
    RecursiveBisection::Ranks ranks{here,
                                    std::vector<unsigned int>(items.size(),
                                                              numbers::invalid_unsigned_int),
                                    [&](std::vector<char> &needed) {
                                      if (!coarse_cells)
                                        needed.assign(needed.size(), 1);
                                      else
                                        for (unsigned int layer = 0; layer < 2; ++layer)
                                          add_neighbours(mesh, needed);
                                    },
                                    std::vector<char>(items.size(), 0)};
    RecursiveBisection::bisect_kinds(items, n_ranks, ghosts, ranks);

    TriangulationDescription::Description<dim, dim> description;
    const auto describe = [&](Triangulation<dim> &triangulation, const auto &rank_of) {
      for (const auto &cell : triangulation.active_cell_iterators())
        cell->set_subdomain_id(rank_of(cell));
      description = TriangulationDescription::Utilities::create_description_from_triangulation(
        triangulation, communicator, TriangulationDescription::Settings::default_setting, here);
    };
    if (!coarse_cells)
      describe(whole, [&](const auto &cell) { return ranks.of_item[cell->active_cell_index()]; });
    else
      {
        std::vector<unsigned int> cells;
        for (unsigned int c = 0; c < ranks.needed.size(); ++c)
          if (ranks.needed[c])
            cells.push_back(c);
        Triangulation<dim> part(smoothing);
        create_triangulation(part_of(mesh, cells), part);
        describe(part, [&](const auto &cell) { return ranks.of_item[cells[cell->index()]]; });
        // Coarse cells by their numbers in the whole mesh.
        for (auto &id : description.coarse_cell_index_to_coarse_cell_id)
          id = cells[id];
        for (auto &cell : description.cell_infos.front())
          cell.id =
            CellId(cells[CellId(cell.id).get_coarse_cell_id()], 0, nullptr).to_binary<dim>();
      }
    auto triangulation = std::make_unique<DistributedMesh>(communicator);
    for (const auto &[id, manifold] : mesh.manifolds)
      triangulation->set_manifold(id, *manifold);
    triangulation->create_triangulation(description);
    if (coarse_cells)
      triangulation->refine_alike(refinements);
    return triangulation;
  }
} // namespace Touchstone
