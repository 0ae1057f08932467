// Built-in geometries: cells, volumes and areas before and after refinement,
// nodes on the exact surfaces, refused parameters. What volume and areas should
// be stands in the titles.

#include "mesh_common.h"

using namespace Touchstone;

int
main()
{
  print_geometry("box: 1 x 2 x 3 = 6",
                 "box",
                 "set Upper corner = 1, 2, 3\nset Cells = 4, 2, 3\nset Grading = 5, 1, 0.2");
  print_geometry("turned box: 6",
                 "box",
                 "set Lower corner = 1, 1, 1\nset Upper corner = 2, 3, 4\n"
                 "set Rotation = 30, -45, 10");

  print_geometry("tube sector: 0.245437; inner 0.392699, outer 0.589049",
                 "tube",
                 "set Inner radius = 1\nset Outer radius = 1.5\nset End = 0.25\n"
                 "set Cells = 4, 12, 1\nset Radial grading = 2");
  print_geometry("outer tube of two_tubes: 276.434",
                 "tube",
                 "set Axis = x\nset End = 10\nset Inner radius = 8\n"
                 "set Inner slope = 0.01\nset Outer radius = 10\nset Cells = 4, 18, 19");
  print_geometry("closed tube about y: 9.424778; inner 6.283185, outer 12.566371",
                 "tube",
                 "set Axis = y\nset Origin = 1, 2, 3\nset Start = -0.5\nset End = 0.5\n"
                 "set Angle = 360\nset Cells = 1, 16, 2");

  print_geometry("cylinder: 3.141593; side 6.283185", "cylinder", "");
  print_geometry("half cylinder about x: 6.283185; side 6.283185, first cut 4",
                 "cylinder",
                 "set Axis = x\nset Part = half\nset Radius = 2\nset Cells = 3, 2, 1");
  print_geometry("quarter cylinder: 0.785398",
                 "cylinder",
                 "set Axis = y\nset Part = quarter\nset Cells = 2, 3, 2");

  print_geometry("ball: 4.188790; surface 12.566371", "ball", "set Centre = 1, 2, 3");
  print_geometry("octant: 0.523599; surface 1.570796, cuts 0.785398",
                 "ball",
                 "set Keep = +, -, +\nset Cells = 3, 2");

  const std::string cap =
    "set Width = 3\nset Height = 4\nset Contact width = 0.5\nset Contact cells = 3\n"
    "set Outer cells = 4\nset Contact layers = 2\nset Outer layers = 3\n";
  print_geometry("quarter of a cap: 33.2403", "cap", cap + "set Radius = 10\nset Apex = 1, 2, 3");
  print_geometry("whole cap, facing up: 132.961",
                 "cap",
                 cap + "set Radius = 10\nset Contact side = top\nset Part = whole");
  print_geometry("flat cap: 36", "cap", cap + "set Radius = 0\nset Contact side = top");

  const std::string slice = cap + "set Shape = cylinder\nset Depth = 0.5\n";
  print_geometry("half of a cylindrical cap: 5.77186, face 1.523463",
                 "cap",
                 slice + "set Radius = 10\nset Apex = 1, 2, 3\nset Part = half");
  print_geometry("cylindrical cap, facing up: 11.543721, face 3.046927",
                 "cap",
                 slice + "set Radius = 10\nset Contact side = top\nset Part = whole\n" +
                   "set Depth cells = 2");

  for (const auto &[type, text] : std::vector<std::pair<std::string, std::string>>{
         {"box", "set Upper corner = 1, 0, 1"},
         {"tube", "set End = -1"},
         {"tube", "set Inner slope = -1"},
         {"tube", "set Outer slope = -1"},
         {"tube", "set Angle = 0"},
         {"tube", "set Angle = 360\nset Cells = 1, 2, 1"},
         {"cylinder", "set Radius = 0"},
         {"cylinder", "set Start = 2"},
         {"ball", "set Radius = 0"},
         {"cap", "set Contact width = 1"},
         {"cap", "set Radius = 1"},
         {"cap", "set Radius = 1.5\nset Height = 0.3"},
         {"cap", "set Part = half"},
         {"cap", "set Shape = cylinder"},
         {"cap", "set Shape = cylinder\nset Part = whole\nset Depth = 0"},
         {"cap", "set Shape = cylinder\nset Part = whole\nset Radius = 1"},
         {"file", ""},
         {"file", "set File = x.stl"},
         {"file", "set File = x.msh\nset Exact surfaces = a: torus radius 1"},
         {"file", "set File = x.msh\nset Exact surfaces = a: cylinder axis 0 0"}})
    print_error([&, type = type, text = text] { make_geometry(type, text); });
}
