// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/row_nodes.h>

// The messages between contact rows and the owners of their nodes (doc/explicit.md, section 9.4).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    constexpr int tag_forward = 171, tag_sum = 172;

    /** Messages of bytes with neighbours; empty ones are not sent. */
    struct Messages
    {
      const MPI_Comm     comm;
      const int          tag;
      MPI_Request *const requests;
      unsigned int       n_requests = 0;

      void
      receive(void *const values, const std::size_t n_bytes, const unsigned int rank)
      {
        if (n_bytes > 0)
          check(MPI_Irecv(values, n_bytes, MPI_BYTE, rank, tag, comm, &requests[n_requests++]));
      }

      void
      send(const void *const values, const std::size_t n_bytes, const unsigned int rank)
      {
        if (n_bytes > 0)
          check(MPI_Isend(values, n_bytes, MPI_BYTE, rank, tag, comm, &requests[n_requests++]));
      }

      static void
      check(const int error)
      {
        AssertThrowMPI(error);
      }

      void
      wait()
      {
        if (n_requests > 0)
          check(MPI_Waitall(n_requests, requests, MPI_STATUSES_IGNORE));
      }
    };
  } // namespace



  void
  RowNodes::exchange(char *const values, const std::size_t size) const
  {
    Assert(size <= 16 * sizeof(double), ExcInternalError());
    char *place = buffer.data();
    for (const Neighbour &neighbour : neighbours)
      for (const unsigned int node : neighbour.wanted)
        {
          std::memcpy(place, values + node * size, size);
          place += size;
        }
    Messages messages{comm, tag_forward, requests.data()};
    for (const Neighbour &neighbour : neighbours)
      messages.receive(values + neighbour.first_ghost * size,
                       neighbour.n_ghosts * size,
                       neighbour.rank);
    place = buffer.data();
    for (const Neighbour &neighbour : neighbours)
      {
        messages.send(place, neighbour.wanted.size() * size, neighbour.rank);
        place += neighbour.wanted.size() * size;
      }
    messages.wait();
  }



  void
  RowNodes::exchange_slots(const std::vector<Tensor<1, dim>> &at_slots) const
  {
    std::size_t place = 0;
    for (const Neighbour &neighbour : neighbours)
      for (const std::size_t slot : neighbour.sent_slots)
        sent[place++] = at_slots[slot];
    constexpr std::size_t size = sizeof(Tensor<1, dim>);
    Messages              messages{comm, tag_sum, requests.data()};
    for (const Neighbour &neighbour : neighbours)
      messages.receive(received.data() + neighbour.first_received,
                       neighbour.n_received * size,
                       neighbour.rank);
    place = 0;
    for (const Neighbour &neighbour : neighbours)
      {
        messages.send(sent.data() + place, neighbour.sent_slots.size() * size, neighbour.rank);
        place += neighbour.sent_slots.size();
      }
    messages.wait();
  }



  Tensor<1, dim>
  RowNodes::sum_at(const unsigned int node, const std::vector<Tensor<1, dim>> &at_slots) const
  {
    const std::size_t n_own = nodes_of_slots.size();
    Tensor<1, dim>    total;
    for (std::size_t c = begin[node]; c < begin[node + 1]; ++c)
      {
        const std::size_t slot = contributions[c];
        total += slot < n_own ? at_slots[slot] : received[slot - n_own];
      }
    return total;
  }



  void
  RowNodes::sum(const std::vector<Tensor<1, dim>> &at_slots,
                std::vector<Tensor<1, dim>>       &sums) const
  {
    exchange_slots(at_slots);
    for (unsigned int node = 0; node < first_ghost; ++node)
      sums[node] = sum_at(node, at_slots);
  }



  void
  RowNodes::sum_shared(const std::vector<Tensor<1, dim>> &at_slots,
                       std::vector<Tensor<1, dim>>       &sums) const
  {
    exchange_slots(at_slots);
    for (const unsigned int node : shared)
      sums[node] = sum_at(node, at_slots);
  }
} // namespace Touchstone
