// Mesh files: Gmsh 2.2 and 4.1, Abaqus and VTK give the same bodies; what is
// wrong with a file is said.

#include "mesh_common.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  const std::string folder = SOURCE_DIR "/meshes";

  BodyMesh
  read(const std::string &text, const double factor = 1.)
  {
    return make_geometry("file", text)->create(factor, "Body x/Geometry", folder);
  }

  void
  print(const std::string &text)
  {
    std::string title = text;
    std::replace(title.begin(), title.end(), '\n', ';');
    std::cout << title << '\n';
    const BodyMesh   mesh = read(text);
    Triangulation<3> triangulation;
    create_triangulation(mesh, triangulation);
    for (unsigned int level = 0; level < 2; ++level)
      {
        std::map<types::boundary_id, double> areas;
        double                               volume, distance;
        measure(mesh, triangulation, areas, volume, distance);
        std::cout << "  level " << level << ": " << triangulation.n_active_cells() << " cells, "
                  << triangulation.n_used_vertices() << " vertices, volume " << volume
                  << ", off the exact surface " << small(distance) << '\n';
        for (const auto &[name, id] : mesh.boundary_names)
          std::cout << "    " << name << ' ' << id << ": " << areas[id] << '\n';
        triangulation.refine_global(1);
      }
  }

  /** The message without the folder, which differs between machines. */
  void
  print_message(const std::string &text, const double factor = 1.)
  {
    try
      {
        read(text, factor);
        std::cout << "no error FAILED\n";
      }
    catch (const InputError &error)
      {
        std::string message = error.what();
        const auto  at      = message.find(folder);
        if (at != std::string::npos)
          message.replace(at, folder.size(), "FOLDER");
        std::cout << message << '\n';
      }
  }
} // namespace

int
main()
{
  print("set File = two_blocks_v2.msh");
  print("set File = two_blocks_v2.msh\nset Volume = lower block");
  print("set File = two_blocks_v2.msh\nset Volume = 2");
  print("set File = two_blocks_v4.msh\nset Volume = lower block");
  print("set File = two_blocks_v4.msh\nset Volume = upper block");
  print("set File = two_blocks.inp\nset Volume = LOWER");
  print("set File = two_blocks.inp\nset Volume = UPPER");
  print("set File = two_blocks.vtk\nset Volume = 1\nset Boundary names = base: 1");
  print("set File = two_blocks.vtk\nset Volume = 2\nset Boundary names = lid: 3");
  print("set File = left_handed.msh");
  print("set File = gmsh_v2.msh");
  print("set File = gmsh_v4.msh");
  print("set File = ../../prm/meshes/press_fit_quarter.msh\nset Volume = inner tube\n"
        "set Exact surfaces = inner_bore: cylinder axis z radius 0.5 inside; inner_skin: "
        "cylinder axis z radius 1.001; cells: cylinder radius 1");
  print("set File = ../../prm/meshes/press_fit_quarter.msh\nset Volume = outer tube\n"
        "set Exact surfaces = outer_bore: cone axis 0 0 2 point 0 0 1 radius 1 slope 0 "
        "inside; outer_skin: cylinder radius 1.5");

  print_message("set File = two_blocks_v2.msh\nset Volume = middle");
  print_message("set File = two_blocks.vtk\nset Boundary names = side: 7");
  print_message("set File = two_blocks_v2.msh\nset Exact surfaces = side: sphere radius 1");
  print_message("set File = two_blocks_v2.msh\nset Exact surfaces = base: sphere radius 1");
  print_message("set File = two_blocks_v2.msh", 1.25);
  print_message("set File = missing.msh");
  print_message("set File = truncated.msh");
  print_message("set File = truncated_v4.msh");
  print_message("set File = truncated.inp");
  print_message("set File = truncated.vtk");
  print_message("set File = inverted.msh");
  print_message("set File = folded.msh");
  print_message("set File = tetrahedra.msh");
  print_message("set File = empty.msh");
  print_message("set File = no_cells.msh");
}
