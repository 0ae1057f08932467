// SPDX-License-Identifier: LGPL-2.1-or-later
// The output folder: files appear complete or not at all, and a folder that
// cannot be written to, a full disk and a vanished folder are errors on all
// ranks. Root may write anywhere, so permissions cannot be tested by taking
// them away.

#include <touchstone/base/folder.h>
#include <touchstone/output/log.h>
#include <touchstone/output/statistics.h>

#include <filesystem>
#include <fstream>
#include <iostream>

using namespace Touchstone;

namespace
{
  /** Print what @p action throws, and check that all ranks throw. */
  void
  attempt(const std::string &what, const std::function<void()> &action)
  {
    const MPI_Comm communicator = MPI_COMM_WORLD;
    std::string    message      = "no error";
    try
      {
        action();
      }
    catch (const OutputError &error)
      {
        message = error.what();
      }
    for (const std::string &other : dealii::Utilities::MPI::all_gather(communicator, message))
      if (other != message)
        message = "The ranks disagree: " + message + " / " + other;
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      std::cout << what << ": " << message << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const MPI_Comm                           communicator = MPI_COMM_WORLD;
  const bool root = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;

  if (root)
    {
      std::filesystem::remove_all("folder_test");
      std::ofstream("a_file") << "in the way\n";
    }
  MPI_Barrier(communicator);

  attempt("below a file", [&]() { OutputFolder("a_file/results", communicator); });
  attempt("is a file", [&]() { OutputFolder("a_file", communicator); });
  attempt("in /proc", [&]() { OutputFolder("/proc/results", communicator); });

  const OutputFolder folder("folder_test/results", communicator);
  attempt("write", [&]() { folder.write_file_atomically("summary.json", "{}\n"); });
  attempt("pieces", [&]() {
    folder.write_pieces_atomically("piece." + std::to_string(folder.rank), whole("piece\n"));
  });

  // The temporary file is a link to the device that is always full.
  if (root)
    std::filesystem::create_symlink("/dev/full", folder.path("summary.json.part"));
  MPI_Barrier(communicator);
  attempt("full disk", [&]() { folder.write_file_atomically("summary.json", "{\"a\": 1}\n"); });
  if (root)
    {
      std::string text;
      std::getline(std::ifstream(folder.path("summary.json")), text);
      std::cout << "summary.json is still: " << text << std::endl;
      std::filesystem::create_symlink("/dev/full", folder.path("log"));
    }
  MPI_Barrier(communicator);
  attempt("full log", [&]() {
    Log log(folder, root ? &std::cout : nullptr);
    log.line("A line.");
    log.check();
  });

  Statistics statistics(folder);
  attempt("statistics", [&]() {
    ConvergedStep record;
    record.number             = 1;
    record.pairs["joint"]     = PairResult();
    record.energies["strain"] = 0.5;
    statistics.add_step(record);
    record.number                  = 2;
    record.reactions["inner/left"] = dealii::Tensor<1, dim>({1., 2., -3.});
    statistics.add_step(record);
  });
  if (root)
    {
      std::cout << std::ifstream(folder.path("statistics")).rdbuf();
      std::filesystem::remove_all("folder_test");
    }
  MPI_Barrier(communicator);
  attempt("removed folder", [&]() { folder.write_file_atomically("summary.json", "{}\n"); });
  if (root)
    std::filesystem::remove("a_file");
  return 0;
}
