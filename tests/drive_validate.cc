// SPDX-License-Identifier: LGPL-2.1-or-later
// What --validate says of bodies, boundaries, gaps and what contact holds; not of cost, which is an
// estimate.

#include <touchstone/drive/simulation.h>

#include "drive_support.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  void
  print(const std::string              &title,
        const std::string              &text,
        const std::vector<std::string> &overrides)
  {
    const Scene scene(text, "scene.prm", overrides);
    const auto  lines = validate(scene, "", MPI_COMM_WORLD);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
      return;
    std::cout << title << '\n';
    for (const std::string &line : lines)
      std::cout << "  " << line.substr(0, line.find(" one core: ")) << '\n';
    std::cout << std::flush;
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  print("two blocks, one of them made of two parts",
        blocks,
        {"Body base/Material/Density=2",
         "Body block/Geometry/Array=1, 1, 2",
         "Body block/Geometry/Array spacing=0, 0, 0.75"});
  std::string loose = blocks;
  loose.replace(loose.find("set Displacement x"),
                loose.find("  end\nend\nsubsection Contact") - loose.find("set Displacement x"),
                "set Traction z = -1\n");
  print("held by contact, with an overlap",
        loose,
        {"Body block/Geometry/Move=0, 0, -0.002", "Discretisation/Degree=2"});
  print("explicit",
        blocks,
        {"Body base/Material/Density=2",
         "Body block/Material/Density=2",
         "Time integration/Scheme=central_differences"});
  return 0;
}
