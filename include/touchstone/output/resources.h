// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_resources_h
#define touchstone_output_resources_h

#include <deal.II/base/mpi.h>

namespace Touchstone
{
  /** @brief CPU time, user and system, that all ranks have used so far, s.
   * Collective. */
  double
  cpu_seconds(MPI_Comm communicator);

  /** @brief Sum over the ranks of the largest memory that each has occupied so
   * far, MB of 10^6 bytes. Collective. */
  double
  peak_memory_mb(MPI_Comm communicator);
} // namespace Touchstone

#endif
