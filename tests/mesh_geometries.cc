// SPDX-License-Identifier: LGPL-2.1-or-later
// Built-in geometries: cells, volumes and areas before and after refinement,
// nodes on the exact surfaces, shape of cells, refused parameters. What volume and areas should
// be stands in the titles.

#include "mesh_common.h"

using namespace Touchstone;

namespace
{
  /** Volumes and areas of boxes and tubes. */
  void
  boxes_and_tubes()
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
  }



  /** Volumes and areas of cylinders and balls, and of parts of them. */
  void
  cylinders_and_balls()
  {
    print_geometry("cylinder: 3.141593; side 6.283185", "cylinder", "");
    print_geometry("half cylinder about x: 6.283185; side 6.283185, first cut 4",
                   "cylinder",
                   "set Axis = x\nset Part = half\nset Radius = 2\nset Cells = 3, 2, 1");
    print_geometry("quarter cylinder: 0.785398",
                   "cylinder",
                   "set Axis = y\nset Part = quarter\nset Cells = 2, 3, 2");

    print_geometry("graded cylinder: 3.141593; side 6.283185",
                   "cylinder",
                   "set Cells = 1, 1, 4\nset Axial grading = 8");

    print_geometry("cylinder graded to its side: 3.141593; side 6.283185",
                   "cylinder",
                   "set Cells = 1, 4, 1\nset Radial grading = 0.2");

    print_geometry("ball: 4.188790; surface 12.566371", "ball", "set Centre = 1, 2, 3");
    print_geometry("ball graded to its surface: 4.188790; surface 12.566371",
                   "ball",
                   "set Cells = 1, 4\nset Radial grading = 0.2");
    print_geometry("octant: 0.523599; surface 1.570796, cuts 0.785398",
                   "ball",
                   "set Keep = +, -, +\nset Cells = 3, 2");
  }



  /** Volumes and areas of caps, spherical, flat and cylindrical. */
  void
  caps()
  {
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
  }



  /** Volumes and areas of quarters of round blocks with rings of cells. */
  void
  round_caps()
  {
    const std::string rings =
      "set Edges = 0.5\nset Edge size = 0.1\nset Largest size = 0.2\nset Growth = 2\n"
      "set Outer growth = 2\nset Layer growth = 3\nset Core radius = 0.15\nset Cells = 2\n";
    print_geometry("flat round cap: 0.785398; contact and far 0.785398, side 1.570796",
                   "round cap",
                   rings + "set Apex = 1, 2, 3");
    print_geometry(
      "round cap, facing up, with a rim of great circles between its nodes, so less than 0.765697; "
      "contact 0.787372, far 0.785398",
      "round cap",
      rings + "set Radius = 10\nset Contact side = top");
  }



  /** Volumes and areas of blocks with oblique faces and of plates with rounded corners. */
  void
  blocks_and_rounded_plates()
  {
    // Trapezoid between 44 and 16 high and 48 wide, and a frustum of a pyramid.
    print_geometry("Cook's membrane: 1440; left 44, right 16, front 65.115282, back 50.596443",
                   "block",
                   "set Corners = 0, 0, 0; 48, 44, 0; 48, 60, 0; 0, 44, 0\nset Cells = 4, 3, 1\n"
                   "set Grading = 1, 2, 1");
    print_geometry("frustum: 28; bottom 16, top 4, others 9.486833",
                   "block",
                   "set Corners = -2, -2, 0; 2, -2, 0; 2, 2, 0; -2, 2, 0; "
                   "-1, -1, 3; 1, -1, 3; 1, 1, 3; -1, 1, 3\nset Cells = 2, 2, 2");

    // Area a b - (1 - pi/4) r^2, rounding pi/2 r.
    print_geometry(
      "rounded plate: 2.973175; back, front 5.946350; fillet 0.392699, sides 0.75, 1.25",
      "rounded plate",
      "set Corner = 1, 2, 3\nset First direction = 0, 3, 4\n"
      "set Second direction = -1, 0, 0\nset Side lengths = 2, 3\n"
      "set Thickness = 0.5\nset Corner radius = 0.5\nset Cells = 3, 4\n"
      "set Grading = 2\nset Layers = 2");
    // That of plate_drop.prm: 6,048 cells and 7,940 nodes.
    print_geometry("plate that drops: 0.124785; back, front 1.247854; fillet 0.0157080",
                   "rounded plate",
                   "set First direction = 1, 0, 0.5\nset Second direction = -0.5, 0, 1\n"
                   "set Side lengths = 1.118033988749895, 1.118033988749895\n"
                   "set Cells = 32, 32\nset Fillet cells = 4\nset Rows = 3\nset Layers = 4\n"
                   "set Grading = 2.4");
  }



  /** Parameters that describe no body are refused. */
  void
  refused_parameters()
  {
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
           {"round cap", "set Radius = 0.9"},
           {"round cap", "set Edges = 0.5, 0.25"},
           {"round cap", "set Core radius = 0.3"},
           {"block", "set Corners = 0, 0, 0; 1, 0, 0; 1, 1, 0; 0, 1, 0; 0, 0, 1"},
           {"block", "set Corners = 0, 0, 0; 0, 1, 0; 1, 1, 0; 1, 0, 0"},
           {"block", "set Corners = 0, 0, 0; 2, 0, 0; 0.5, 0.5, 0; 0, 2, 0"},
           {"rounded plate", "set First direction = 0, 0, 0"},
           {"rounded plate", "set Second direction = 1, 1, 0"},
           {"rounded plate", "set Thickness = 0"},
           {"rounded plate", "set Corner radius = 1"},
           {"rounded plate", "set Corner radius = 0.8\nset Rows = 3"},
           {"file", ""},
           {"file", "set File = x.stl"},
           {"file", "set File = x.msh\nset Exact surfaces = a: torus radius 1"},
           {"file", "set File = x.msh\nset Exact surfaces = a: cylinder axis 0 0"}})
      print_error([&, type = type, text = text] { make_geometry(type, text); });
  }
} // namespace



int
main()
{
  boxes_and_tubes();
  cylinders_and_balls();
  caps();
  round_caps();
  blocks_and_rounded_plates();
  refused_parameters();
  return 0;
}
