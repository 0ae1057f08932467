// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_tests_extending_support_h
#define touchstone_tests_extending_support_h

#include <touchstone/base/input_error.h>
#include <touchstone/drive/simulation.h>
#include <touchstone/scene/command_line.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

namespace Touchstone
{
  /** Print on the first rank only. */
  template <class... Parts>
  void
  say(const Parts &...parts)
  {
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        (std::cout << ... << parts);
        std::cout << std::endl;
      }
  }

  /** "below 1e-6", or the number if it is not. */
  inline std::string
  bound(const std::string &name, const double number, const double limit)
  {
    char text[80];
    if (number < limit)
      std::snprintf(text, sizeof(text), " below %g", limit);
    else
      std::snprintf(text, sizeof(text), " %.3e, not below %g", number, limit);
    return name + text;
  }

  /** A file of the project. */
  inline std::string
  file_text(const std::string &name)
  {
    return read_scene_file(SOURCE_DIR "/../" + name);
  }

  /** Run a scene, with results in the folder @p name. */
  inline RunSummary
  run_scene(const std::string &text, std::string name, std::vector<std::string> overrides)
  {
    std::replace(name.begin(), name.end(), ' ', '_');
    overrides.insert(overrides.begin(), {"Output/Directory=" + name, "Output/VTU interval=0"});
    const Scene scene(text, "scene.prm", overrides);
    return Simulation(scene, SOURCE_DIR, nullptr, MPI_COMM_WORLD).run();
  }
} // namespace Touchstone

#endif
