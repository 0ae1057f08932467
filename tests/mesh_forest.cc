// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies in one forest: touching bodies are not merged, boundaries have ids of
// their own, the factor of two_tubes gives the cells it should.

#include <touchstone/mesh/forest.h>
#include <touchstone/scene/scene.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_handler.h>

#include "mesh_common.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  std::string
  body(const std::string &name, const std::string &geometry)
  {
    return "subsection Body " + name + "\nsubsection Geometry\n" + geometry +
           "end\nsubsection Material\nset Young modulus = 1\nend\nend\n";
  }

  Scene
  make_scene(const std::string &text,
             const std::string &factor,
             const std::string &partitioner = "p4est")
  {
    return Scene(text,
                 "test.prm",
                 {"Discretisation/Refinement factor=" + factor,
                  "Discretisation/Partitioner=" + partitioner});
  }

  /** Cells and vertices of all ranks, and how far boundary vertices are from the
   * exact surfaces. */
  void
  print_counts(const std::string              &title,
               const std::string              &text,
               const std::vector<std::string> &factors,
               const std::string              &partitioner = "p4est")
  {
    for (const std::string &factor : factors)
      {
        const Scene   scene = make_scene(text, factor, partitioner);
        const Forest  forest(scene.forest_input(), ".", MPI_COMM_WORLD);
        const FE_Q<3> fe(1);
        DoFHandler<3> vertices(forest.triangulation);
        vertices.distribute_dofs(fe);

        double distance = 0.;
        for (const auto &cell : forest.triangulation.active_cell_iterators())
          if (cell->is_locally_owned())
            for (const auto &face : cell->face_iterators())
              if (face->at_boundary())
                if (const auto surface = forest.surface(face->boundary_id()))
                  for (const unsigned int v : face->vertex_indices())
                    distance =
                      std::max(distance,
                               face->vertex(v).distance(surface->project(face->vertex(v))));
        distance = Utilities::MPI::max(distance, MPI_COMM_WORLD);
        if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          std::cout << title << ", factor " << factor << ": "
                    << forest.triangulation.n_global_active_cells() << " cells, "
                    << vertices.n_dofs() << " vertices, off the exact surface " << small(distance)
                    << '\n';
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const MPI_Comm                         world = MPI_COMM_WORLD;

  const std::string boxes =
    "set Bodies = lower, upper\n" + body("lower", "set Type = box\nset Cells = 2, 2, 1\n") +
    body("upper",
         "set Type = box\nset Lower corner = 0, 0, 1\nset Upper corner = 1, 1, 2\n"
         "set Cells = 2, 2, 1\n");
  // Each rank has only its own cells: printed serially.
  if (Utilities::MPI::n_mpi_processes(world) == 1)
    {
      const Scene  scene = make_scene(boxes, "1");
      const Forest forest(scene.forest_input(), ".", world);
      std::cout << forest.n_bodies() << " bodies, " << forest.triangulation.n_active_cells()
                << " cells, " << forest.triangulation.n_used_vertices() << " vertices\n";
      for (const auto &cell : forest.triangulation.active_cell_iterators())
        std::cout << "  body " << cell->material_id() << " at " << cell->center() << '\n';
      for (const char *name : {"top", "5", "left"})
        for (unsigned int b = 0; b < 2; ++b)
          std::cout << "  " << name << " of body " << b << ": "
                    << *forest.boundary(b, name, "s", "k").begin() << '\n';
      std::cout << "  exact surface of a plane side: "
                << (forest.surface(0) ? "yes FAILED" : "none") << '\n';
      print_error([&] { forest.boundary(0, "outer", "Body lower", "Fixed"); });
    }

  const std::string tubes =
    "set Bodies = outer, inner\n" +
    body("outer",
         "set Type = tube\nset Axis = x\nset End = 10\nset Inner radius = 8\n"
         "set Inner slope = 0.01\nset Outer radius = 10\nset Cells = 4, 18, 19\n") +
    body("inner",
         "set Type = tube\nset Axis = x\nset Start = 5\nset End = 15\n"
         "set Inner radius = 6.051\nset Outer radius = 8.001\nset Outer slope = 0.01\n"
         "set Cells = 4, 19, 20\n");
  const std::string round =
    "set Bodies = ball, octant, cylinder, cap\n" + body("ball", "set Type = ball\n") +
    body("octant", "set Type = ball\nset Keep = +, -, +\nset Centre = 3, 0, 0\n") +
    body("cylinder", "set Type = cylinder\nset Axis = x\n") +
    body("cap", "set Type = cap\nset Radius = 10\n");

  print_counts("round bodies", round, {"1", "2"});
  print_counts("two tubes", tubes, {"0.5", "1", "1.25", "2", "4"});
  print_counts("two tubes by METIS", tubes, {"1", "2"}, "METIS");
  // Coarse cells are handed out of the tubes, which have many, and refined ones of the others.
  print_counts("two tubes by coordinates", tubes, {"1", "2"}, "coordinates");
  print_counts("round bodies by coordinates", round, {"1", "2"}, "coordinates");
  return 0;
}
