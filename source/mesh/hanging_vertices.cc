// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/hanging_vertices.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <memory>
#include <vector>

// Positions of vertices that hang (doc/theory.md 11).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    using Mesh = parallel::distributed::Triangulation<dim>;

    class HangingVertices
    {
    public:
      explicit HangingVertices(Mesh &triangulation)
        : triangulation(triangulation)
      {
      }

      /** Move those that hang. Collective. */
      void
      move();
      /** Undo move(). */
      void
      restore();

    private:
      Mesh &triangulation;
      /** Of all vertices before any was moved; empty if none was. */
      std::vector<Point<dim>> on_surface;

      /** Marks those of this rank. */
      std::vector<bool>
      move_own();
    };



    std::vector<bool>
    HangingVertices::move_own()
    {
      const std::vector<bool> owned = GridTools::get_locally_owned_vertices(triangulation);
      std::vector<bool>       moved(triangulation.n_vertices(), false);
      const auto              place = [&](auto child, const unsigned int v, const Point<dim> &x) {
        const unsigned int index = child->vertex_index(v);
        if (owned[index])
          {
            child->vertex(v) = x;
            moved[index]     = true;
          }
      };
      // Larger cells first: the ends of an edge may hang themselves.
      for (unsigned int level = 0; level < triangulation.n_levels(); ++level)
        for (const auto &cell : triangulation.active_cell_iterators_on_level(level))
          if (!cell->is_artificial())
            {
              for (const unsigned int f : cell->face_indices())
                if (const auto face = cell->face(f); face->has_children())
                  place(face->child(0), 3, face->center());
              for (const unsigned int l : cell->line_indices())
                if (const auto line = cell->line(l); line->has_children())
                  place(line->child(0), 1, line->center());
            }
      return moved;
    }



    void
    HangingVertices::move()
    {
      std::vector<Point<dim>> before = triangulation.get_vertices();
      const std::vector<bool> moved  = move_own();
      const int any = std::find(moved.begin(), moved.end(), true) != moved.end() ? 1 : 0;
      if (Utilities::MPI::max(any, triangulation.get_communicator()) == 0)
        return;
      triangulation.communicate_locally_moved_vertices(moved);
      on_surface = std::move(before);
    }



    void
    HangingVertices::restore()
    {
      if (on_surface.empty())
        return;
      for (const auto &cell : triangulation.cell_iterators())
        for (const unsigned int v : cell->vertex_indices())
          cell->vertex(v) = on_surface[cell->vertex_index(v)];
      on_surface = {};
    }
  } // namespace



  void
  keep_hanging_vertices(Mesh &triangulation)
  {
    // The mesh owns what acts on it.
    const auto vertices = std::make_shared<HangingVertices>(triangulation);
    auto      &signals  = triangulation.signals;
    for (auto *const signal :
         {&signals.pre_distributed_refinement, &signals.pre_distributed_repartition})
      signal->connect([vertices]() { vertices->restore(); });
    for (auto *const signal :
         {&signals.post_distributed_refinement, &signals.post_distributed_repartition})
      signal->connect([vertices]() { vertices->move(); });
  }
} // namespace Touchstone
