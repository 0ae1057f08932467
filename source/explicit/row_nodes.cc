// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/explicit/row_nodes.h>

#include <algorithm>
#include <map>

// The nodes of contact rows across ranks. Rows live where their slave node does, and name nodes of
// any rank, so neither the ghost layer of the mesh nor its messages serve them.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A slot on a node of the rank that is asked. */
    struct SlotRequest
    {
      Index  dof;
      RowKey key;
    };

    constexpr int tag_forward = 171, tag_sum = 172;
  } // namespace



  RowNodes::RowNodes(const MPI_Comm communicator)
    : comm(communicator)
  {
  }



  void
  RowNodes::reinit(const IndexSet &owned, const std::vector<std::pair<Index, RowKey>> &slots)
  {
    // Owners of the nodes of other ranks.
    IndexSet foreign(owned.size());
    for (const auto &slot : slots)
      if (!owned.is_element(slot.first))
        foreign.add_index(slot.first);
    foreign.compress();
    const std::vector<unsigned int> owners =
      Utilities::MPI::n_mpi_processes(comm) == 1
        ? std::vector<unsigned int>()
        : Utilities::MPI::compute_index_owner(owned, foreign, comm);
    const auto owner = [&](const Index dof) { return owners[foreign.index_within_set(dof)]; };

    std::map<unsigned int, std::vector<SlotRequest>> requests_to;
    std::map<unsigned int, std::vector<std::size_t>> slots_of;
    for (std::size_t s = 0; s < slots.size(); ++s)
      if (!owned.is_element(slots[s].first))
        {
          const unsigned int rank = owner(slots[s].first);
          requests_to[rank].push_back({slots[s].first, slots[s].second});
          slots_of[rank].push_back(s);
        }
    const auto asked = exchange_records(requests_to, comm);

    // Owned nodes that any row mentions, in the order of their dofs.
    std::map<Index, unsigned int> local;
    for (const auto &slot : slots)
      if (owned.is_element(slot.first))
        local.emplace(slot.first, 0);
    for (const auto &of_rank : asked)
      for (const SlotRequest &request : of_rank.second)
        local.emplace(request.dof, 0);
    dofs.clear();
    for (auto &[dof, number] : local)
      {
        number = dofs.size();
        dofs.push_back(dof);
      }
    first_ghost = dofs.size();

    // Ghosts of a rank follow one another, in the order of their dofs, which both sides know.
    std::map<unsigned int, Neighbour> by_rank;
    for (const auto &[rank, list] : slots_of)
      {
        Neighbour &neighbour  = by_rank[rank];
        neighbour.sent_slots  = list;
        neighbour.first_ghost = dofs.size();
        std::vector<Index> ghosts;
        for (const std::size_t s : list)
          ghosts.push_back(slots[s].first);
        std::sort(ghosts.begin(), ghosts.end());
        ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
        for (const Index dof : ghosts)
          {
            local.emplace(dof, dofs.size());
            dofs.push_back(dof);
          }
        neighbour.n_ghosts = ghosts.size();
      }
    struct Contribution
    {
      RowKey      key;
      std::size_t slot;
    };
    std::vector<std::vector<Contribution>> of_node(first_ghost);
    std::size_t                            n_received = slots.size();
    for (const auto &[rank, list] : asked)
      {
        Neighbour &neighbour     = by_rank[rank];
        neighbour.first_received = n_received - slots.size();
        neighbour.n_received     = list.size();
        std::vector<Index> nodes;
        for (const SlotRequest &request : list)
          {
            nodes.push_back(request.dof);
            of_node[local.at(request.dof)].push_back({request.key, n_received++});
          }
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        for (const Index dof : nodes)
          neighbour.wanted.push_back(local.at(dof));
      }
    nodes_of_slots.clear();
    for (std::size_t s = 0; s < slots.size(); ++s)
      {
        nodes_of_slots.push_back(local.at(slots[s].first));
        if (nodes_of_slots.back() < first_ghost)
          of_node[nodes_of_slots.back()].push_back({slots[s].second, s});
      }
    begin.assign(1, 0);
    contributions.clear();
    for (auto &list : of_node)
      {
        // Slots of one row are all here or all from one rank, and keep their order.
        std::stable_sort(list.begin(), list.end(), [](const auto &a, const auto &b) {
          return a.key < b.key;
        });
        for (const Contribution &contribution : list)
          contributions.push_back(contribution.slot);
        begin.push_back(contributions.size());
      }

    neighbours.clear();
    std::size_t n_sent = 0, n_wanted = 0;
    for (auto &[rank, neighbour] : by_rank)
      {
        neighbour.rank = rank;
        n_sent += neighbour.sent_slots.size();
        n_wanted += neighbour.wanted.size();
        neighbours.push_back(std::move(neighbour));
      }
    sent.resize(n_sent);
    received.resize(n_received - slots.size());
    requests.resize(2 * neighbours.size());
    // The largest value that is sent is a symmetric tensor beside two vectors.
    buffer.resize(n_wanted * 16 * sizeof(double));
  }



  void
  RowNodes::exchange(char *const values, const std::size_t size) const
  {
    if (neighbours.empty())
      return;
    Assert(size <= 16 * sizeof(double), ExcInternalError());
    unsigned int n_requests = 0;
    for (const Neighbour &neighbour : neighbours)
      if (neighbour.n_ghosts > 0)
        {
          const int error = MPI_Irecv(values + neighbour.first_ghost * size,
                                      neighbour.n_ghosts * size,
                                      MPI_BYTE,
                                      neighbour.rank,
                                      tag_forward,
                                      comm,
                                      &requests[n_requests++]);
          AssertThrowMPI(error);
        }
    char *place = buffer.data();
    for (const Neighbour &neighbour : neighbours)
      if (!neighbour.wanted.empty())
        {
          char *const first = place;
          for (const unsigned int node : neighbour.wanted)
            {
              std::memcpy(place, values + node * size, size);
              place += size;
            }
          const int error = MPI_Isend(first,
                                      place - first,
                                      MPI_BYTE,
                                      neighbour.rank,
                                      tag_forward,
                                      comm,
                                      &requests[n_requests++]);
          AssertThrowMPI(error);
        }
    const int error = MPI_Waitall(n_requests, requests.data(), MPI_STATUSES_IGNORE);
    AssertThrowMPI(error);
  }



  void
  RowNodes::sum(const std::vector<Tensor<1, dim>> &at_slots,
                std::vector<Tensor<1, dim>>       &sums) const
  {
    unsigned int n_requests = 0;
    for (const Neighbour &neighbour : neighbours)
      if (neighbour.n_received > 0)
        {
          const int error = MPI_Irecv(received.data() + neighbour.first_received,
                                      neighbour.n_received * sizeof(Tensor<1, dim>),
                                      MPI_BYTE,
                                      neighbour.rank,
                                      tag_sum,
                                      comm,
                                      &requests[n_requests++]);
          AssertThrowMPI(error);
        }
    std::size_t place = 0;
    for (const Neighbour &neighbour : neighbours)
      if (!neighbour.sent_slots.empty())
        {
          const std::size_t first = place;
          for (const std::size_t slot : neighbour.sent_slots)
            sent[place++] = at_slots[slot];
          const int error = MPI_Isend(sent.data() + first,
                                      (place - first) * sizeof(Tensor<1, dim>),
                                      MPI_BYTE,
                                      neighbour.rank,
                                      tag_sum,
                                      comm,
                                      &requests[n_requests++]);
          AssertThrowMPI(error);
        }
    if (n_requests > 0)
      {
        const int error = MPI_Waitall(n_requests, requests.data(), MPI_STATUSES_IGNORE);
        AssertThrowMPI(error);
      }
    const std::size_t n_own = nodes_of_slots.size();
    for (unsigned int node = 0; node < first_ghost; ++node)
      {
        Tensor<1, dim> total;
        for (std::size_t c = begin[node]; c < begin[node + 1]; ++c)
          {
            const std::size_t slot = contributions[c];
            total += slot < n_own ? at_slots[slot] : received[slot - n_own];
          }
        sums[node] = total;
      }
  }
} // namespace Touchstone
