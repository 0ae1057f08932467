// SPDX-License-Identifier: LGPL-2.1-or-later
// Constants of a scene and files that it includes: what they give, and what is refused.

#include "scene_support.h"
#include <filesystem>
#include <fstream>

namespace
{
  using Touchstone::InputError;
  using Touchstone::Scene;

  const std::string title = "set Title         = Two blocks";

  /** The good scene with these constants, and a modulus that uses them. */
  void
  try_constants(const std::string              &what,
                const std::string              &constants,
                const std::string              &modulus   = "210000",
                const std::vector<std::string> &overrides = {})
  {
    try_scene(what,
              replaced(replaced(good_scene, title, "set Constants = " + constants),
                       "= 210000",
                       "= " + modulus),
              overrides);
  }

  /** What formulas and numbers have become. */
  void
  show(const std::string              &what,
       const std::string              &text,
       const std::string              &file,
       const std::vector<std::string> &overrides = {})
  {
    std::cout << "* " << what << '\n';
    try
      {
        const Scene        scene(text, file, overrides);
        std::ostringstream printed;
        printed << scene.complete_entries();
        std::istringstream lines(printed.str());
        for (std::string line; std::getline(lines, line);)
          for (const std::string key : {"set Constants",
                                        "set Young",
                                        "set Pressure  ",
                                        "set Motion z",
                                        "set Upper",
                                        "set Cells",
                                        "set Steps",
                                        "set Title"})
            if (line.find(key) != std::string::npos)
              std::cout << "  " << line.substr(line.find("set")) << '\n';
      }
    catch (const InputError &error)
      {
        std::cout << "  " << error.what() << '\n';
      }
    std::cout << std::flush;
  }

  void
  write(const std::string &name, const std::string &text)
  {
    std::ofstream(name) << text;
  }
} // namespace

int
main()
{
  std::string text =
    replaced(good_scene, title, "set Constants = p0 = 2*E/R, E = 2e5, R = 10, n = 3");
  text = replaced(text, "= 210000", "= E + 2*R");
  text = replaced(text, "set Pressure = 5*t", "set Pressure = -p0*t*sin(R*x) + 1e3*R");
  text = replaced(text, "set Motion z = 0.2*t", "set Motion z = -R*t");
  text = replaced(text,
                  "set Type = box",
                  "set Type = box\nset Upper corner = R/3, max(R, 2), 2\n"
                  "set Cells = n*R/10, 2*n, 4");
  show("formulas, numbers and lists", text, "scene.prm");
  show("a constant of the command line", text, "scene.prm", {"Constants=R = 20, n = 2"});
  show("expressions in overrides", text, "scene.prm", {"Load stepping/Steps=n^2"});

  try_constants("in any order", "a = b + 1, b = 2", "a");
  try_constants("unused", "a = 1");
  try_constants("no value", "a");
  try_constants("empty value", "a = ");
  try_constants("empty item", "a = 1,, b = 2");
  try_constants("no name", "2a = 1");
  try_constants("a name of formulas", "t = 1");
  try_constants("a function", "sin = 1");
  try_constants("twice", "a = 1, a = 2");
  try_constants("in a circle", "a = b, b = a");
  try_constants("unknown", "a = c, b = 1");
  try_constants("infinite", "a = 1/0");
  try_constants("of position", "a = x");
  try_constants("of chance", "a = rand()");
  try_constants("twice as many is no product", "a = 3", "2a");
  try_constants("misspelt in a number", "radius = 3", "raduis");
  try_constants("out of bounds", "a = 3", "-a");
  try_constants("no whole number", "a = 3", "1", {"Load stepping/Steps=a/2"});
  try_constants("unknown on the command line", "a = 3", "a", {"Constants=A = 2"});
  try_constants("list of another length", "a = 3", "a", {"Body lower/Geometry/Cells=a, a"});
  try_change("misspelt in a formula", "= 5*t", "= p0*t");
  try_override("time in a number", {"Body lower/Material/Young modulus=2*t"});

  // Files of one folder below, which include each other by names relative to themselves.
  std::filesystem::create_directories("scene_constants");
  const auto in_folder = [](const std::string &name) { return "scene_constants/" + name; };
  write(in_folder("base.prm"),
        replaced(good_scene, title, "set Title = Base\nset Constants = E = 7, F = 2*E"));
  write(in_folder("material.prm"), "set Young modulus = 3\n\nset Densty = 1\n");
  write(in_folder("open.prm"), "subsection Newton\n");
  write(in_folder("close.prm"), "\nend\n");
  write(in_folder("itself.prm"), "include ../scene_constants/around.prm\n");
  write(in_folder("around.prm"), "# a comment\ninclude itself.prm\n");
  write(in_folder("empty.prm"), "");
  const auto try_include = [&](const std::string &what, const std::string &lines) {
    show(what, lines, in_folder("main.prm"));
  };
  try_include("include", "include base.prm");
  try_include("changed thereafter",
              "include base.prm\nset Title = Variant\nset Constants = E = 9\n"
              "subsection Body lower\nsubsection Material\nset Young modulus = F\nend\nend");
  try_include("changed before", "set Title = Variant\ninclude base.prm");
  try_include("constant changed before", "set Constants = E = 1\ninclude base.prm");
  try_include("included twice", "include base.prm\ninclude base.prm");
  try_include("misspelt key in the third line",
              replaced(good_scene, "set Young modulus = 210000", "include material.prm"));
  try_include("a line behind it", "include base.prm\nsett Title = x");
  try_include("left open", "\ninclude open.prm\nend");
  try_include("closed elsewhere", "subsection Newton\ninclude close.prm");
  try_include("circle", "include around.prm");
  try_include("missing", "\n\ninclude misssing.prm");
  try_include("a folder", "include ../scene_constants");
  try_include("empty", "include empty.prm");
  try_include("no name", "include");
  return 0;
}
