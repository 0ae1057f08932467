#ifndef touchstone_algebra_multigrid_neighbours_h
#define touchstone_algebra_multigrid_neighbours_h

#include <deal.II/base/mpi.h>

#include <map>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief Ranks, and how many unknowns each shares: as dealii::Utilities::MPI::Partitioner
   * lists them. */
  using Neighbours = std::vector<std::pair<unsigned int, unsigned int>>;

  /**
   * @brief Numbers for and from ranks that know of each other.
   *
   * The same as dealii::Utilities::MPI::some_to_some(), which first finds out who sends to
   * whom, and copies all of it into bytes and back.
   * @param packages By rank, for ranks of @p to only; those without get none.
   * @param to Ranks that have this one in their @p from.
   * @return Pairs of a rank of @p from and what it has sent, in the order of @p from.
   * @throws dealii::ExcMPI, dealii::ExcInternalError if a package is for another rank.
   * Collective for the ranks concerned.
   */
  std::vector<std::pair<unsigned int, std::vector<double>>>
  exchange_with_neighbours(const std::map<unsigned int, std::vector<double>> &packages,
                           const Neighbours                                  &to,
                           const Neighbours                                  &from,
                           MPI_Comm                                           communicator);
} // namespace Touchstone

#endif
