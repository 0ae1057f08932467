// SPDX-License-Identifier: LGPL-2.1-or-later
// A chain of constraint lines that goes through all ranks: each one knows a line of its own and
// must get all that follow.

#include <touchstone/algebra/shared_lines.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iostream>

using namespace Touchstone;
using namespace dealii;

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const Index                      rank     = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  const Index                      n        = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const Index                      per_rank = 4;

  IndexSet owned(per_rank * n);
  owned.add_range(per_rank * rank, per_rank * (rank + 1));
  // x_first = x_(first of the next rank) / 2 + 1; the last one is free.
  std::vector<AffineConstraints<double>::ConstraintLine> lines;
  if (rank + 1 < n)
    {
      lines.emplace_back(per_rank * rank);
      lines.back().entries.emplace_back(per_rank * (rank + 1), 0.5);
      lines.back().inhomogeneity = 1.;
    }
  AffineConstraints<double> constraints =
    gather_lines(std::move(lines), owned, owned, MPI_COMM_WORLD);
  constraints.close();

  // All lines from this rank on are there, each refers to the last dof alone.
  bool right = constraints.n_constraints() == n - 1 - rank;
  for (Index r = rank; right && r + 1 < n; ++r)
    {
      const double factor  = std::pow(0.5, n - 1 - r);
      const auto  &entries = *constraints.get_constraint_entries(per_rank * r);
      right                = entries.size() == 1 && entries[0].first == per_rank * (n - 1) &&
              std::abs(entries[0].second - factor) < 1e-15 &&
              std::abs(constraints.get_inhomogeneity(per_rank * r) - 2. * (1. - factor)) < 1e-15;
    }
  right = Utilities::MPI::min(static_cast<int>(right), MPI_COMM_WORLD) == 1;
  if (rank == 0)
    std::cout << "lines through all ranks: " << (right ? "OK" : "FAILED") << std::endl;
  return 0;
}
