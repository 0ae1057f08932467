// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_first_of_ranks_h
#define touchstone_base_first_of_ranks_h

#include <deal.II/base/mpi.h>

#include <limits>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Of the lists of numbers of all ranks the first in lexicographic order, on all ranks:
   * one reduction for each number, whatever the number of ranks.
   *
   * @param mine Numbers of one length on all ranks, without NaN; or none where a rank has no list.
   * @param n    That length. @return none if no rank has a list. Collective.
   */
  inline std::vector<double>
  first_of_ranks(const std::vector<double> &mine, const unsigned int n, const MPI_Comm communicator)
  {
    bool first = !mine.empty();
    if (dealii::Utilities::MPI::max(static_cast<int>(first), communicator) == 0)
      return {};
    std::vector<double> result(n);
    for (unsigned int i = 0; i < n; ++i)
      {
        result[i] =
          dealii::Utilities::MPI::min(first ? mine[i] : std::numeric_limits<double>::infinity(),
                                      communicator);
        first = first && mine[i] == result[i];
      }
    return result;
  }
} // namespace Touchstone

#endif
