// SPDX-License-Identifier: LGPL-2.1-or-later
// What the user sees of a run, apart from the times.

#include <touchstone/output/progress.h>

#include <filesystem>
#include <iostream>
#include <sstream>

using namespace Touchstone;

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const OutputFolder                       folder("progress_test", MPI_COMM_WORLD);

  std::ostringstream terminal;
  Log                log(folder, &terminal);
  Progress           progress(log, 2.);
  progress.begin_step(1, 4, 0.5);
  progress.iteration({1, 0.123456, 4.5e-3, 1234, 1234, 32});
  progress.iteration({2, 7e-11, 1e-16, 1230, 4, 8});
  progress.end_step(2);
  progress.begin_step(2, 4, 1.);
  progress.cut_step("the active set cycles", 0.25);
  progress.iteration({1, 1., 1., 1, 0, -1});
  log.check();

  std::ifstream      file(folder.path("log"));
  std::ostringstream contents;
  contents << file.rdbuf();
  std::cout << "log and terminal agree: " << (contents.str() == terminal.str()) << std::endl;

  std::istringstream lines(terminal.str());
  std::string        line;
  while (std::getline(lines, line))
    std::cout << (line.find("converged in") == std::string::npos ? line : "  (times)") << std::endl;

  for (const double seconds : {0.04, 59.94, 59.96, 125., 3599.7, 5400.})
    std::cout << readable_duration(seconds) << std::endl;
  std::filesystem::remove_all("progress_test");
  return 0;
}
