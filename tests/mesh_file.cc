// SPDX-License-Identifier: LGPL-2.1-or-later
// Mesh files: Gmsh 2.2 and 4.1, Abaqus and VTK give the same bodies; what is
// wrong with a file is said.

#include "mesh_common.h"
#include <fstream>
#include <functional>
#include <set>

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
  print_message(const std::string &text, const double factor = 1., const std::string &in = folder)
  {
    try
      {
        make_geometry("file", text)->create(factor, "Body x/Geometry", in);
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

  using Lines = std::vector<std::string>;

  /** The first line that is @p front, or else that begins with it. */
  Lines::iterator
  find(Lines &lines, const std::string &front)
  {
    const auto same = std::find(lines.begin(), lines.end(), front);
    if (same != lines.end())
      return same;
    for (auto line = lines.begin(); line != lines.end(); ++line)
      if (line->compare(0, front.size(), front) == 0)
        return line;
    throw std::runtime_error("There is no line '" + front + "'. FAILED");
  }

  /** A copy of the file @p name with a fault. */
  void
  damage(const std::string &name, const std::function<void(Lines &)> &fault)
  {
    Lines         lines;
    std::ifstream in(folder + "/" + name);
    for (std::string line; std::getline(in, line);)
      lines.push_back(line);
    fault(lines);
    std::ofstream out("damaged_" + name);
    for (const std::string &line : lines)
      out << line << '\n';
  }

  void
  print_damaged(const std::string &name, const std::function<void(Lines &)> &fault)
  {
    damage(name, fault);
    print_message("set File = damaged_" + name, 1., ".");
  }

  /** A line more or a line less, with all counts as they were. */
  void
  print_doubled_and_missing(const std::string &name, const std::string &line)
  {
    print_damaged(name, [&](Lines &lines) {
      const auto at = find(lines, line);
      lines.insert(at, std::string(*at));
    });
    print_damaged(name, [&](Lines &lines) { lines.erase(find(lines, line)); });
  }

  /** A second line for the cell in the line @p from, which becomes @p to, and another line
   * changed alike. */
  void
  print_copied(const std::string                                      &name,
               const std::string                                      &from,
               const std::string                                      &to,
               const std::vector<std::pair<std::string, std::string>> &counts)
  {
    print_damaged(name, [&](Lines &lines) {
      const auto  at   = find(lines, from);
      std::string line = *at;
      lines.insert(at + 1, line.replace(0, from.size(), to));
      for (const auto &[old, corrected] : counts)
        *find(lines, old) = corrected;
    });
  }

  void
  print_damaged_files()
  {
    for (const char *line : {"5 0.5", "20 5", "2 1 \"base"})
      print_doubled_and_missing("two_blocks_v2.msh", line);
    for (const char *line : {"28", "0.5 0.5 0", "18 11", "21 0 0 0", "3 22 5 4"})
      print_doubled_and_missing("two_blocks_v4.msh", line);
    for (const char *line : {"0.5 0.5 0", "8 9 10", "4 0 1", "12", "9", "2"})
      print_doubled_and_missing("two_blocks.vtk", line);
    for (const char *line : {"5, 0.5", "2, 2, 3"})
      print_doubled_and_missing("two_blocks.inp", line);

    // The same cell twice, with counts and numbers that are right.
    print_copied("two_blocks_v2.msh", "20 5", "22 5", {{"21", "22"}});
    print_copied("two_blocks_v4.msh",
                 "18 11",
                 "21 11",
                 {{"5 20 1 20", "5 21 1 21"}, {"3 22 5 4", "3 22 5 5"}});
    print_copied("two_blocks.vtk",
                 "8 9 10",
                 "8 9 10",
                 {{"CELLS", "CELLS 21 141"},
                  {"CELL_TYPES", "CELL_TYPES 21"},
                  {"12", "12\n12"},
                  {"CELL_DATA", "CELL_DATA 21"},
                  {"1", "1\n1"}});
    print_damaged("two_blocks.inp", [](Lines &lines) {
      lines.insert(find(lines, "*ELSET"), "9, 10, 11, 14, 13, 19, 20, 23, 22");
    });
    // One number for two cells, a set that is not there.
    print_damaged("two_blocks.inp", [](Lines &lines) {
      lines.insert(find(lines, "*ELSET"), "5, 14, 15, 18, 17, 23, 24, 27, 26");
    });
    print_damaged("two_blocks.inp",
                  [](Lines &lines) { *find(lines, "TOPCELLS, S2") = "TOPCELS, S2"; });
    // Numbers that are none, or only at their beginning.
    for (const char *node : {"5 nan 0.5 0", "5 0.5 1e400 0", "5 0.5 0.5x 0", "-5 0.5 0.5 0"})
      print_damaged("two_blocks_v2.msh", [&](Lines &lines) { *find(lines, "5 0.5") = node; });
  }

  /** Parts of Abaqus, with numbers and sets of their own, where their instances place them. */
  void
  print_assembly()
  {
    for (const char *instance : {"Cube-1", "Cube-2", "Bar_1"})
      {
        const std::string text = std::string("set File = assembly.inp\nset Volume = ") + instance;
        print(text);
        std::set<std::vector<double>> nodes;
        const BodyMesh                mesh = read(text);
        for (const CellData<3> &cell : mesh.cells)
          for (const unsigned int v : cell.vertices)
            nodes.insert({mesh.vertices[v][0], mesh.vertices[v][1], mesh.vertices[v][2]});
        for (const auto &x : nodes)
          std::cout << "    " << x[0] << ' ' << x[1] << ' ' << x[2] << '\n';
        for (const auto &[name, set] : mesh.node_sets)
          std::cout << "    " << name << ": " << set.size() << " nodes\n";
      }
    const std::pair<const char *, const char *> faults[] = {
      {"*Instance, name=Cube-1", "*Instance, name=Cube-1, part=Cylinder"},
      {"         10.,           0.,           0.,          10", "10, 0, 0, 10, 0, 0, 90"},
      {"*Nset, nset=Foot_of_cubes", "*Nset, nset=Foot_of_cubes, instance=Cube-3"},
      {"Cube-2.1, S1", "Cube-3.1, S1"},
      {"*Element", "*Element, type=C3D8R, input=elements.txt"},
      {"*Node", "*Node, system=C"},
      {"*Solid Section", "*Ngen\n1, 8"}};
    for (const auto &[line, fault] : faults)
      print_damaged("assembly.inp",
                    [line = line, fault = fault](Lines &lines) { *find(lines, line) = fault; });
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
  print_assembly();
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
  print_damaged_files();

  // A cell of two physical volumes stands twice in Gmsh's version 2, but is one cell.
  damage("two_blocks_v2.msh", [](Lines &lines) {
    *find(lines, "21")   = "22";
    *find(lines, "20 5") = *find(lines, "20 5") + "\n22 5 2 7 2 13 14 17 16 22 23 26 25";
  });
  for (const char *volume : {"", "\nset Volume = 7"})
    std::cout << "cells in two volumes: "
              << make_geometry("file", std::string("set File = damaged_two_blocks_v2.msh") + volume)
                   ->create(1., "", ".")
                   .cells.size()
              << '\n';

  // A face that stands in two boundaries belongs to both.
  damage("two_blocks_v2.msh", [](Lines &lines) {
    *find(lines, "21") = "22";
    lines.insert(find(lines, "14 5"), "22 3 2 2 1 1 2 5 4");
  });
  const BodyMesh mesh =
    make_geometry("file", "set File = damaged_two_blocks_v2.msh")->create(1., "", ".");
  for (const auto &[id, boundaries] : mesh.shared)
    {
      std::cout << "faces of boundary";
      for (const auto boundary : boundaries)
        std::cout << ' ' << boundary;
      std::cout << ": "
                << std::count_if(mesh.subcells.boundary_quads.begin(),
                                 mesh.subcells.boundary_quads.end(),
                                 [id = id](const auto &face) { return face.boundary_id == id; })
                << '\n';
    }
  return 0;
}
