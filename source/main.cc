// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/base/interruption.h>
#include <touchstone/drive/simulation.h>
#include <touchstone/output/model_export.h>
#include <touchstone/output/preview.h>
#include <touchstone/scene/command_line.h>
#include <touchstone/scene/own_keys.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <iostream>
#ifdef __GLIBC__
#  include <malloc.h>
#endif

namespace
{
  using namespace Touchstone;

  /**
   * Exit codes besides 0, which means that every step converged; part of the interface to scripts.
   */
  enum ExitCode
  {
    bad_input     = 1,
    not_converged = 2,
    no_output     = 3,
    broken        = 4,
    interrupted   = 5
  };

  /**
   * SuperLU_DIST, which Debian's Trilinos is linked with, tells malloc when it is loaded never to
   * give memory back to the system: what the largest temporary took would be lost to all that
   * comes after. These are the defaults of glibc but for the threshold, which otherwise
   * grows with each array that is freed.
   */
  void
  give_memory_back()
  {
#ifdef __GLIBC__
    mallopt(M_MMAP_MAX, 65536);
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
    mallopt(M_TRIM_THRESHOLD, 1 << 24);
#endif
  }



  /**
   * Parse the command line and execute it. All ranks take the same path; the first one
   * prints. @return the exit code.
   */
  int
  run(const int argc, char **argv, const MPI_Comm communicator)
  {
    const bool        first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    const CommandLine line  = CommandLine::parse(argc, argv);
    if (line.help || line.version)
      {
        if (first)
          std::cout << (line.help ? CommandLine::usage() : "Touchstone " TOUCHSTONE_VERSION "\n");
        return 0;
      }
    if (line.print_own_keys)
      {
        if (first)
          print_own_keys(std::cout);
        return 0;
      }
    const Scene scene(read_scene_file(line.scene_file), line.scene_file, line.overrides);
    // Mesh files are named relative to the scene.
    const std::string folder = std::filesystem::path(line.scene_file).parent_path().string();
    if (line.print_parameters)
      {
        if (first)
          scene.print(std::cout);
        return 0;
      }
    if (line.validate)
      {
        const std::vector<std::string> remarks = validate(scene, folder, communicator);
        if (first)
          {
            std::cout << line.scene_file << ": valid\n";
            for (const std::string &remark : remarks)
              std::cout << "  " << remark << '\n';
          }
        return 0;
      }

    if (line.preview)
      {
        for (const std::string &text : write_preview(scene, folder, communicator))
          if (first)
            std::cout << text << '\n';
        return 0;
      }

    if (!line.export_model.empty())
      {
        export_model(scene, folder, line.export_model, communicator);
        return 0;
      }

    Simulation simulation(
      scene, folder, line.results_only ? nullptr : &std::cout, communicator, line.resume);
    const RunSummary summary = simulation.run();
    if (first)
      {
        // With --results-only nothing is printed that round-off decides, such as numbers of
        // iterations: the output can be compared between runs.
        summary.print_results(std::cout, /*with_iterations=*/!line.results_only);
        if (!line.results_only)
          {
            for (const std::string &text : simulation.comparison())
              std::cout << text << '\n';
            std::cout << "Wall time " << readable_duration(summary.seconds.wall) << ". Results in "
                      << scene.output.directory << ": ";
            for (const std::string &list : simulation.written_lists())
              std::cout << list << ", ";
            std::cout << "statistics, summary.json\n";
          }
        // In one piece, or mpirun mixes it with the standard output.
        if (!summary.converged)
          std::cerr << (summary.interrupted ? "Interrupted: " : "Not converged: ") +
                         summary.failure + '\n';
      }
    return summary.converged ? 0 : summary.interrupted ? interrupted : not_converged;
  }
} // namespace



int
main(int argc, char **argv)
{
  give_memory_back();
  // One thread per rank: parallel runs use MPI processes.
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const MPI_Comm                           communicator = MPI_COMM_WORLD;
  const bool first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  // MPI has its own handlers until here.
  Interruption::listen();
  try
    {
      return run(argc, argv, communicator);
    }
  catch (const InputError &error)
    {
      if (first)
        std::cerr << error.what() << '\n';
      return bad_input;
    }
  catch (const OutputError &error)
    {
      if (first)
        std::cerr << error.what() << '\n';
      return no_output;
    }
  catch (const std::exception &error)
    {
      // An unforeseen error may have happened on this rank alone, and the others would wait for
      // ever in their next collective call: abort all of them. Input and output errors, in
      // contrast, are thrown on all ranks together.
      std::cerr << "Touchstone broke down: " << error.what() << '\n';
      MPI_Abort(communicator, broken);
      return broken;
    }
}
