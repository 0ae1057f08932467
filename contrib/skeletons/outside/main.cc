// SPDX-License-Identifier: LGPL-2.1-or-later
// A program of its own around the library: runs a scene, looks at the displacements and
// contact rows after each step, and judges the result. Usage: outside scene.prm

#include <touchstone/base/input_error.h>
#include <touchstone/drive/simulation.h>
#include <touchstone/scene/command_line.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <iostream>

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc != 2)
    return 1;
  const std::string file = argv[1];
  try
    {
      const Touchstone::Scene scene(Touchstone::read_scene_file(file),
                                    file,
                                    {"Output/VTU interval = 0"});
      Touchstone::Simulation  simulation(scene,
                                        std::filesystem::path(file).parent_path().string(),
                                        /*terminal=*/nullptr,
                                        MPI_COMM_WORLD);

      // Called on all ranks, so sums over them are possible.
      simulation.after_step([](const Touchstone::ConvergedStep &step) {
        double pressure = 0.;
        for (const Touchstone::ContactPoint &point : step.points)
          pressure = std::max(pressure, point.pressure);
        pressure             = dealii::Utilities::MPI::max(pressure, MPI_COMM_WORLD);
        const double largest = step.displacement->linfty_norm();
        if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          std::cout << "step " << step.number << ", t = " << step.time << ": largest displacement "
                    << largest << ", largest pressure " << pressure << std::endl;
      });

      const Touchstone::RunSummary summary = simulation.run();
      return summary.converged ? 0 : 2;
    }
  catch (const Touchstone::InputError &error)
    {
      std::cerr << error.what() << std::endl;
      return 1;
    }
}
