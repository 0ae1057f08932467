#include <touchstone/algebra/multigrid/neighbours.h>

#include <deal.II/base/exceptions.h>

namespace Touchstone
{
  using namespace dealii;

  std::vector<std::pair<unsigned int, std::vector<double>>>
  exchange_with_neighbours(const std::map<unsigned int, std::vector<double>> &packages,
                           const Neighbours                                  &to,
                           const Neighbours                                  &from,
                           const MPI_Comm                                     communicator)
  {
    constexpr int            tag    = 4711;
    std::size_t              n_sent = 0;
    std::vector<MPI_Request> requests;
    for (const auto &neighbour : to)
      {
        const auto        package = packages.find(neighbour.first);
        const bool        any     = package != packages.end();
        const std::size_t size    = any ? package->second.size() : 0;
        AssertThrow(size < 1u << 31, ExcMessage("A message of more than 2^31 numbers."));
        n_sent += any;
        requests.emplace_back();
        const int error = MPI_Isend(any ? package->second.data() : nullptr,
                                    static_cast<int>(size),
                                    MPI_DOUBLE,
                                    static_cast<int>(neighbour.first),
                                    tag,
                                    communicator,
                                    &requests.back());
        AssertThrowMPI(error);
      }
    AssertThrow(n_sent == packages.size(), ExcInternalError());

    std::vector<std::pair<unsigned int, std::vector<double>>> result;
    for (const auto &neighbour : from)
      {
        const int  rank = static_cast<int>(neighbour.first);
        MPI_Status status;
        int        size  = 0;
        int        error = MPI_Probe(rank, tag, communicator, &status);
        AssertThrowMPI(error);
        error = MPI_Get_count(&status, MPI_DOUBLE, &size);
        AssertThrowMPI(error);
        result.emplace_back(neighbour.first, std::vector<double>(size));
        error = MPI_Recv(result.back().second.data(),
                         size,
                         MPI_DOUBLE,
                         rank,
                         tag,
                         communicator,
                         MPI_STATUS_IGNORE);
        AssertThrowMPI(error);
      }
    const int error =
      MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    AssertThrowMPI(error);
    return result;
  }
} // namespace Touchstone
