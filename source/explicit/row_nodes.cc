// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/explicit/row_nodes.h>

#include <algorithm>
#include <map>
#include <numeric>

// The nodes of contact rows across ranks. Rows live where their slave node does, and name nodes of
// any rank, so neither the ghost layer of the mesh nor its messages serve them.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The owner of the node of each slot; of those of other ranks. */
    std::vector<unsigned int>
    owners_of(const IndexSet                              &owned,
              const std::vector<std::pair<Index, RowKey>> &slots,
              const MPI_Comm                               comm)
    {
      std::vector<unsigned int> result(slots.size(), numbers::invalid_unsigned_int);
      if (Utilities::MPI::n_mpi_processes(comm) == 1)
        return result;
      IndexSet foreign(owned.size());
      for (const auto &slot : slots)
        if (!owned.is_element(slot.first))
          foreign.add_index(slot.first);
      foreign.compress();
      const auto owners = Utilities::MPI::compute_index_owner(owned, foreign, comm);
      for (std::size_t s = 0; s < slots.size(); ++s)
        if (!owned.is_element(slots[s].first))
          result[s] = owners[foreign.index_within_set(slots[s].first)];
      return result;
    }

    /** The dofs of a list, each once, in ascending order. */
    template <class List, class Dof>
    std::vector<Index>
    sorted(const List &list, const Dof &dof)
    {
      std::vector<Index> result;
      for (const auto &entry : list)
        result.push_back(dof(entry));
      std::sort(result.begin(), result.end());
      result.erase(std::unique(result.begin(), result.end()), result.end());
      return result;
    }
  } // namespace



  RowNodes::RowNodes(const MPI_Comm communicator)
    : comm(communicator)
  {
  }



  void
  RowNodes::reinit(const IndexSet &owned, const std::vector<std::pair<Index, RowKey>> &slots)
  {
    // Slots on nodes of other ranks, by rank, and what these are asked.
    const std::vector<unsigned int>                  owners = owners_of(owned, slots, comm);
    std::map<unsigned int, std::vector<SlotRequest>> requests_to;
    std::map<unsigned int, Neighbour>                by_rank;
    for (std::size_t s = 0; s < slots.size(); ++s)
      if (!owned.is_element(slots[s].first))
        {
          requests_to[owners[s]].push_back({slots[s].first, slots[s].second});
          by_rank[owners[s]].sent_slots.push_back(s);
        }
    const Requests asked = exchange_records(requests_to, comm);
    number_owned(owned, slots, asked);
    std::map<Index, unsigned int> ghosts;
    for (auto &[rank, neighbour] : by_rank)
      number_ghosts(neighbour, slots, ghosts);
    nodes_of_slots.resize(slots.size());
    for (std::size_t s = 0; s < slots.size(); ++s)
      {
        const Index dof   = slots[s].first;
        nodes_of_slots[s] = owned.is_element(dof) ? number(owned, dof) : ghosts.at(dof);
      }
    std::size_t n_received = 0;
    for (const auto &[rank, list] : asked)
      {
        Neighbour &neighbour     = by_rank[rank];
        neighbour.first_received = n_received;
        neighbour.n_received     = list.size();
        n_received += list.size();
        for (const Index dof : sorted(list, [](const SlotRequest &request) { return request.dof; }))
          neighbour.wanted.push_back(number(owned, dof));
      }
    order_contributions(owned, slots, asked);

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
    received.resize(n_received);
    requests.resize(2 * neighbours.size());
    // The largest value that is sent is a symmetric tensor beside two vectors.
    buffer.resize(n_wanted * 16 * sizeof(double));
  }



  // Owned nodes that any row mentions, in the order of their dofs.
  void
  RowNodes::number_owned(const IndexSet                              &owned,
                         const std::vector<std::pair<Index, RowKey>> &slots,
                         const Requests                              &asked)
  {
    numbers_of_owned.assign(owned.n_elements(), numbers::invalid_unsigned_int);
    dofs.clear();
    const auto mention = [&](const Index dof) {
      unsigned int &place = numbers_of_owned[owned.index_within_set(dof)];
      if (place == numbers::invalid_unsigned_int)
        {
          place = 0;
          dofs.push_back(dof);
        }
    };
    for (const auto &slot : slots)
      if (owned.is_element(slot.first))
        mention(slot.first);
    for (const auto &of_rank : asked)
      for (const SlotRequest &request : of_rank.second)
        mention(request.dof);
    std::sort(dofs.begin(), dofs.end());
    for (unsigned int node = 0; node < dofs.size(); ++node)
      numbers_of_owned[owned.index_within_set(dofs[node])] = node;
    first_ghost = dofs.size();
  }



  // Ghosts of a rank follow one another, in the order of their dofs, which both sides know.
  void
  RowNodes::number_ghosts(Neighbour                                   &neighbour,
                          const std::vector<std::pair<Index, RowKey>> &slots,
                          std::map<Index, unsigned int>               &ghosts)
  {
    neighbour.first_ghost = dofs.size();
    for (const Index dof :
         sorted(neighbour.sent_slots, [&](const std::size_t s) { return slots[s].first; }))
      {
        ghosts.emplace(dof, dofs.size());
        dofs.push_back(dof);
      }
    neighbour.n_ghosts = dofs.size() - neighbour.first_ghost;
  }



  void
  RowNodes::order_contributions(const IndexSet                              &owned,
                                const std::vector<std::pair<Index, RowKey>> &slots,
                                const Requests                              &asked)
  {
    // Received slots come first at each node, then own ones.
    begin.assign(first_ghost + 1, 0);
    for (const auto &of_rank : asked)
      for (const SlotRequest &request : of_rank.second)
        ++begin[number(owned, request.dof) + 1];
    for (const unsigned int node : nodes_of_slots)
      if (node < first_ghost)
        ++begin[node + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    struct Contribution
    {
      RowKey      key;
      std::size_t slot;
    };
    std::vector<Contribution> all(begin.back());
    std::vector<std::size_t>  next(begin.begin(), begin.end() - 1);
    std::size_t               slot_number = slots.size();
    for (const auto &of_rank : asked)
      for (const SlotRequest &request : of_rank.second)
        all[next[number(owned, request.dof)]++] = {request.key, slot_number++};
    for (std::size_t s = 0; s < slots.size(); ++s)
      if (nodes_of_slots[s] < first_ghost)
        all[next[nodes_of_slots[s]]++] = {slots[s].second, s};
    contributions.resize(all.size());
    for (unsigned int node = 0; node < first_ghost; ++node)
      // Slots of one row are all here or all from one rank, and keep their order: numbers of slots
      // ascend in each row.
      std::sort(all.begin() + begin[node],
                all.begin() + begin[node + 1],
                [](const Contribution &a, const Contribution &b) {
                  return a.key < b.key || (!(b.key < a.key) && a.slot < b.slot);
                });
    for (std::size_t c = 0; c < all.size(); ++c)
      contributions[c] = all[c].slot;
    shared.clear();
    for (const auto &of_rank : asked)
      for (const SlotRequest &request : of_rank.second)
        shared.push_back(number(owned, request.dof));
    std::sort(shared.begin(), shared.end());
    shared.erase(std::unique(shared.begin(), shared.end()), shared.end());
  }
} // namespace Touchstone
