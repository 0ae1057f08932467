// SPDX-License-Identifier: LGPL-2.1-or-later
// Scene files with lines, keys, sections and values that cannot be: every
// message with section, key, value, line and remedy.

#include "scene_support.h"
#include <regex>

int
main()
{
  try_scene("nothing wrong", good_scene);
  try_scene("Windows line ends, tabs, comments, capitals and continued lines",
            "\xEF\xBB\xBFSET\tBodies = a # only one\r\n"
            "SUBSECTION  Body  a\r\nsubsection Geometry\r\nend\r\nsubsection Material\r\n"
            "# nothing\r\nset Young  modulus = \\\r\n  2\r\nend\r\nEND\r\n");
  try_scene("underscores, dots and signs in names",
            std::regex_replace(std::regex_replace(good_scene, std::regex("upper"), "the_upper 50%"),
                               std::regex("below"),
                               "part_2.below"));

  try_change("misspelt key", "set Young modulus = 210000", "set Young modulos = 1");
  try_change("key in the wrong section", "set Title         = Two blocks", "set Degree = 2");
  try_change("nonsense key", "set Title ", "set Blub ");
  try_change("misspelt subsection", "subsection Material", "subsection Materiel");
  try_change("section in the wrong place", "subsection Material", "subsection Discretisation");
  try_change("misspelt body", "subsection Body upper", "subsection Body uper");
  try_scene("body not listed", good_scene + "subsection Body third\nset Element = full\nend\n");
  try_scene("boundary not listed",
            replaced(good_scene,
                     "set Fixed = top",
                     "subsection Boundary left\nset Pressure = 1\nend"));
  try_change("boundary without subsection",
             "Boundary conditions = right",
             "Boundary conditions = right, left");
  try_change("pair without subsection", "between, below", "between, below, aside");
  try_change("name listed twice", "lower, upper", "lower, upper, lower");
  try_change("empty name", "lower, upper", "lower,, upper");
  try_change("empty last name", "lower, upper", "lower, upper,");
  try_change("slash in a name", "lower, upper", "lower, upper/inner");
  try_change("empty list of bodies", "= lower, upper", "=");
  try_scene("empty scene", "");
  try_change("required key is missing", "set Young modulus = 210000", "");
  try_change("required section is missing",
             "subsection Material\n    set Young modulus = 210000\n  end",
             "");

  try_change("no set", "set Title ", "Title ");
  try_change("no equals sign", "set Title         =", "set Title");
  try_change("no key", "set Title", "set");
  try_change("nameless subsection", "subsection Obstacle floor", "subsection");
  try_change("text after end", "  end\n", "  end of it\n");
  try_scene("end is missing", good_scene + "subsection Newton\n");
  try_scene("end too many", good_scene + "end\n");
  try_change("set twice", "set Fixed = top", "set Fixed = top\nset Fixed = left");
  try_change("include", "set Title         = Two blocks", "include other.prm");

  try_change("not a number", "= 210000", "= 210 GPa");
  try_change("decimal comma", "= 0.2\n", "= 0,2\n");
  try_change("not a number, by name", "= 210000", "= nan");
  try_change("infinite", "= 210000", "= 1e999");
  try_change("not a vector", "0, 0, -0.1", "0, 0");
  try_override("not in the selection", {"Linear solver/Type=MUMP"});
  try_override("out of bounds", {"Discretisation/Degree=3"});
  try_override("below the bound", {"Load stepping/Steps=0"});
  try_override("not a whole number", {"Load stepping/Steps=2.5"});
  try_override("empty value", {"Load stepping/Steps="});
  try_change("unknown geometry", "Type = box", "Type = bx");
  try_change("unknown key of a geometry", "Type = box", "Bottom = 1");
  return 0;
}
