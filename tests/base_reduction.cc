// SPDX-License-Identifier: LGPL-2.1-or-later
// Sums and maxima of several kinds in one reduction are those of one after the other.

#include <touchstone/base/reduction.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iostream>
#include <limits>

using namespace Touchstone;
using namespace dealii;

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const MPI_Comm                   communicator = MPI_COMM_WORLD;
  const unsigned int               rank         = Utilities::MPI::this_mpi_process(communicator),
                     n_ranks                    = Utilities::MPI::n_mpi_processes(communicator);
  const bool root                               = rank == 0;

  double sum = 0.1 * (rank + 1), largest = -1. - rank, smallest = -3. - rank,
         broken        = rank + 1 == n_ranks ? std::numeric_limits<double>::quiet_NaN() : 1.;
  std::uint64_t number = 3 + rank, signature = std::uint64_t(1) << 63;
  const double  exact = Utilities::MPI::sum(sum, communicator);
  Reduction     all;
  all.sum(sum);
  all.max(largest);
  all.sum(number);
  all.sum(signature);
  all.max(smallest);
  all.sum(broken);
  all.over(communicator);
  std::uint64_t numbers = 0, signatures = 0;
  for (unsigned int r = 0; r < n_ranks; ++r)
    {
      numbers += 3 + r;
      signatures += std::uint64_t(1) << 63;
    }
  const bool right = std::abs(sum - exact) < 1e-15 && largest == -1. && smallest == -3. &&
                     number == numbers && signature == signatures && std::isnan(broken);
  // The next one begins with nothing.
  double again = 1.;
  all.sum(again);
  all.over(communicator);
  if (root)
    std::cout << "sums and maxima: " << (right ? "right" : "WRONG")
              << ", once more: " << (again == n_ranks ? "right" : "WRONG") << std::endl;
  return 0;
}
