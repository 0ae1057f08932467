// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/resources.h>

#include <deal.II/base/utilities.h>

#include <sys/resource.h>

namespace Touchstone
{
  double
  cpu_seconds(const MPI_Comm communicator)
  {
    // Processor time of all ranks together, of the program and of the system on its behalf.
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval &t) { return t.tv_sec + 1e-6 * t.tv_usec; };
    return dealii::Utilities::MPI::sum(seconds(usage.ru_utime) + seconds(usage.ru_stime),
                                       communicator);
  }



  double
  peak_memory_mb(const MPI_Comm communicator)
  {
    dealii::Utilities::System::MemoryStats stats;
    dealii::Utilities::System::get_memory_stats(stats);
    // VmHWM is the largest resident memory so far, in units of 1024 bytes; 1024e-6 makes megabytes
    // of 10^6 bytes. The sum over the ranks counts shared pages more than once.
    return dealii::Utilities::MPI::sum(1024e-6 * stats.VmHWM, communicator);
  }

} // namespace Touchstone
