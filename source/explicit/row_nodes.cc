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
    const Requests                asked = exchange_records(requests_to, comm);
    std::map<Index, unsigned int> local = number_owned(owned, slots, asked);
    for (auto &[rank, neighbour] : by_rank)
      number_ghosts(neighbour, slots, local);
    nodes_of_slots.clear();
    for (const auto &slot : slots)
      nodes_of_slots.push_back(local.at(slot.first));
    std::size_t n_received = 0;
    for (const auto &[rank, list] : asked)
      {
        Neighbour &neighbour     = by_rank[rank];
        neighbour.first_received = n_received;
        neighbour.n_received     = list.size();
        n_received += list.size();
        for (const Index dof : sorted(list, [](const SlotRequest &request) { return request.dof; }))
          neighbour.wanted.push_back(local.at(dof));
      }
    order_contributions(slots, asked, local);

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
  std::map<Index, unsigned int>
  RowNodes::number_owned(const IndexSet                              &owned,
                         const std::vector<std::pair<Index, RowKey>> &slots,
                         const Requests                              &asked)
  {
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
    return local;
  }



  // Ghosts of a rank follow one another, in the order of their dofs, which both sides know.
  void
  RowNodes::number_ghosts(Neighbour                                   &neighbour,
                          const std::vector<std::pair<Index, RowKey>> &slots,
                          std::map<Index, unsigned int>               &local)
  {
    neighbour.first_ghost = dofs.size();
    for (const Index dof :
         sorted(neighbour.sent_slots, [&](const std::size_t s) { return slots[s].first; }))
      {
        local.emplace(dof, dofs.size());
        dofs.push_back(dof);
      }
    neighbour.n_ghosts = dofs.size() - neighbour.first_ghost;
  }



  void
  RowNodes::order_contributions(const std::vector<std::pair<Index, RowKey>> &slots,
                                const Requests                              &asked,
                                const std::map<Index, unsigned int>         &local)
  {
    struct Contribution
    {
      RowKey      key;
      std::size_t slot;
    };
    std::vector<std::vector<Contribution>> of_node(first_ghost);
    std::size_t                            number = slots.size();
    for (const auto &of_rank : asked)
      for (const SlotRequest &request : of_rank.second)
        of_node[local.at(request.dof)].push_back({request.key, number++});
    for (std::size_t s = 0; s < slots.size(); ++s)
      if (nodes_of_slots[s] < first_ghost)
        of_node[nodes_of_slots[s]].push_back({slots[s].second, s});
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
  }
} // namespace Touchstone
