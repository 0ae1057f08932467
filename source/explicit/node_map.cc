// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/explicit/node_map.h>

#include <algorithm>
#include <cstring>
#include <tuple>
#include <unordered_map>

// Local numbers of nodes and cells for explicit dynamics, in an order that all partitions
// agree on (doc/explicit.md, section 2).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** CellId as a number: the coarse cell, then three bits for each level, and room for a node. */
    class CellKeys
    {
    public:
      explicit CellKeys(const Triangulation<dim> &triangulation, const MPI_Comm communicator)
        : levels(triangulation.n_global_levels() - 1)
      {
        std::uint64_t most = 0;
        for (const auto &cell : triangulation.active_cell_iterators())
          if (!cell->is_artificial())
            most = std::max<std::uint64_t>(most, cell->id().get_coarse_cell_id());
        most = Utilities::MPI::max(most, communicator);
        AssertThrow(dim * (levels + 1) < 64 && (most >> (64 - dim * (levels + 1))) == 0,
                    ExcMessage("The mesh has too many cells for explicit dynamics."));
      }

      std::uint64_t
      operator()(const CellId &id) const
      {
        std::uint64_t key   = id.get_coarse_cell_id();
        unsigned int  level = 0;
        for (const std::uint8_t child : id.get_child_indices())
          {
            key = (key << dim) | child;
            ++level;
          }
        // Active cells do not contain each other: zeros for the levels that are missing do not make
        // two of them the same.
        return key << (dim * (levels - level + 1));
      }

    private:
      const unsigned int levels;
    };
  } // namespace



  NodeMap::NodeMap(const Solid &solid)
    : comm(solid.communicator)
  {
    AssertThrow(solid.fe.degree == 1, ExcMessage("Explicit dynamics is for degree 1."));
    number_nodes(solid, find_cells(solid));
  }



  NodeMap::~NodeMap() = default;



  std::vector<std::array<Index, NodeMap::nodes_per_cell>>
  NodeMap::find_cells(const Solid &solid)
  {
    const CellKeys     key_of(solid.dof_handler.get_triangulation(), comm);
    std::vector<Index> dofs(solid.fe.n_dofs_per_cell());
    struct Found
    {
      Cell                              cell;
      std::array<Index, nodes_per_cell> dofs;
    };
    std::vector<Found> found;
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        {
          bool used = cell->is_locally_owned();
          cell->get_dof_indices(dofs);
          Found one{{key_of(cell->id()), cell->active_cell_index(), cell->material_id(), used}, {}};
          for (unsigned int a = 0; a < nodes_per_cell; ++a)
            {
              one.dofs[a] = dofs[solid.fe.component_to_system_index(0, a)];
              used        = used || solid.owned.is_element(one.dofs[a]);
            }
          if (used)
            found.push_back(one);
        }
    std::sort(found.begin(), found.end(), [](const Found &a, const Found &b) {
      return a.cell.key < b.cell.key;
    });
    std::vector<std::array<Index, nodes_per_cell>> result;
    all_cells.reserve(found.size());
    result.reserve(found.size());
    for (const Found &one : found)
      {
        all_cells.push_back(one.cell);
        result.push_back(one.dofs);
      }
    return result;
  }



  void
  NodeMap::number_nodes(const Solid                                          &solid,
                        const std::vector<std::array<Index, nodes_per_cell>> &dofs)
  {
    struct Node
    {
      std::uint64_t key;
      Index         dof;
      unsigned int  body, owner;
    };
    // Cells ascend: the first one that has a node gives it its key. This is final for owned nodes,
    // all of whose cells are here; ghosts get theirs from their owner.
    std::unordered_map<Index, Node> nodes;
    for (std::size_t c = 0; c < dofs.size(); ++c)
      for (unsigned int a = 0; a < nodes_per_cell; ++a)
        nodes.insert({dofs[c][a], {all_cells[c].key + a, dofs[c][a], all_cells[c].body, 0}});

    // Owners of ghosts.
    const unsigned int me = Utilities::MPI::this_mpi_process(comm);
    IndexSet           ghosts(solid.dof_handler.n_dofs());
    for (const auto &[dof, node] : nodes)
      if (!solid.owned.is_element(dof))
        ghosts.add_index(dof);
    ghosts.compress();
    std::unordered_map<Index, unsigned int> owner_of;
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      {
        const auto   owners = Utilities::MPI::compute_index_owner(solid.owned, ghosts, comm);
        unsigned int k      = 0;
        for (const Index dof : ghosts)
          owner_of[dof] = owners[k++];
      }
    std::vector<Node> sorted;
    for (auto &[dof, node] : nodes)
      {
        const auto owner = owner_of.find(dof);
        node.owner       = owner == owner_of.end() ? me : owner->second;
        sorted.push_back(node);
      }
    // The dof breaks ties of keys of ghosts, which are not final yet.
    std::sort(sorted.begin(), sorted.end(), [me](const Node &a, const Node &b) {
      return std::make_tuple(a.owner != me, a.owner, a.owner == me ? a.key : a.dof) <
             std::make_tuple(b.owner != me, b.owner, b.owner == me ? b.key : b.dof);
    });
    std::vector<unsigned int> owners;
    for (const Node &node : sorted)
      {
        local_numbers.emplace_back(node.dof, first_dofs.size());
        first_dofs.push_back(node.dof);
        keys.push_back(node.key);
        bodies.push_back(node.body);
        owners.push_back(node.owner);
        number_owned += (node.owner == me);
      }
    AssertThrow(dim * std::size_t(number_owned) == solid.owned.n_elements(), ExcInternalError());
    local_numbers.shrink_to_fit();
    first_dofs.shrink_to_fit();
    keys.shrink_to_fit();
    bodies.shrink_to_fit();

    std::sort(local_numbers.begin(), local_numbers.end());

    reference.resize(first_dofs.size());
    nodes_of_cells.resize(dofs.size());
    for (std::size_t c = 0; c < dofs.size(); ++c)
      for (unsigned int a = 0; a < nodes_per_cell; ++a)
        nodes_of_cells[c][a] = local(dofs[c][a]);
    const Triangulation<dim> &mesh = solid.dof_handler.get_triangulation();
    std::vector<unsigned int> by_index(mesh.n_active_cells(), numbers::invalid_unsigned_int);
    for (unsigned int c = 0; c < all_cells.size(); ++c)
      by_index[all_cells[c].index] = c;
    for (const auto &cell : mesh.active_cell_iterators())
      if (const unsigned int c = by_index[cell->active_cell_index()];
          c != numbers::invalid_unsigned_int)
        for (unsigned int a = 0; a < nodes_per_cell; ++a)
          reference[nodes_of_cells[c][a]] = cell->vertex(a);
    plan_messages(owners);
    // Positions agree on all ranks already. Keys of ghosts:
    exchange(keys.data(), sizeof(keys[0]));
  }



  void
  NodeMap::plan_messages(const std::vector<unsigned int> &owners)
  {
    std::map<unsigned int, std::vector<Index>> wanted;
    std::map<unsigned int, Neighbour>          all;
    for (unsigned int n = number_owned; n < n_local(); ++n)
      {
        Neighbour &of = all[owners[n]];
        if (of.n_ghosts++ == 0)
          of.first_ghost = n;
        wanted[owners[n]].push_back(first_dofs[n]);
      }
    for (const auto &[rank, dofs] : exchange_records(wanted, comm))
      for (const Index dof : dofs)
        {
          const unsigned int node = local(dof);
          AssertThrow(node != dealii::numbers::invalid_unsigned_int, ExcInternalError());
          all[rank].sent.push_back(node);
        }
    for (auto &[rank, neighbour] : all)
      {
        neighbour.rank = rank;
        neighbours.push_back(neighbour);
      }
    requests.resize(2 * neighbours.size());
  }



  void
  NodeMap::exchange(void *values, const std::size_t size) const
  {
    if (neighbours.empty())
      return;
    constexpr int tag = 822;
    std::size_t   n   = 0;
    for (const Neighbour &neighbour : neighbours)
      n += neighbour.sent.size();
    buffer.resize(n * size);
    char *const  bytes = static_cast<char *>(values);
    char        *next  = buffer.data();
    unsigned int k     = 0;
    int          error;
    for (const Neighbour &neighbour : neighbours)
      {
        error = MPI_Irecv(bytes + neighbour.first_ghost * size,
                          neighbour.n_ghosts * size,
                          MPI_BYTE,
                          neighbour.rank,
                          tag,
                          comm,
                          &requests[k++]);
        AssertThrowMPI(error);
        char *const first = next;
        for (const unsigned int node : neighbour.sent)
          {
            std::memcpy(next, bytes + node * size, size);
            next += size;
          }
        error = MPI_Isend(first, next - first, MPI_BYTE, neighbour.rank, tag, comm, &requests[k++]);
        AssertThrowMPI(error);
      }
    error = MPI_Waitall(k, requests.data(), MPI_STATUSES_IGNORE);
    AssertThrowMPI(error);
  }



  unsigned int
  NodeMap::local(const Index first_dof) const
  {
    const auto found =
      std::lower_bound(local_numbers.begin(), local_numbers.end(), std::make_pair(first_dof, 0U));
    return found == local_numbers.end() || found->first != first_dof
             ? dealii::numbers::invalid_unsigned_int
             : found->second;
  }



  void
  NodeMap::update_ghosts(NodeField &field) const
  {
    exchange(field.data(), sizeof(field[0]));
  }



  void
  NodeMap::update_ghosts(std::vector<double> &field) const
  {
    exchange(field.data(), sizeof(double));
  }



  void
  NodeMap::to_vector(const NodeField &field, Vector &vector) const
  {
    for (unsigned int n = 0; n < number_owned; ++n)
      for (unsigned int d = 0; d < dim; ++d)
        vector(first_dofs[n] + d) = field[n][d];
    vector.compress(VectorOperation::insert);
  }



  void
  NodeMap::from_vector(const Vector &vector, NodeField &field) const
  {
    for (unsigned int n = 0; n < number_owned; ++n)
      for (unsigned int d = 0; d < dim; ++d)
        field[n][d] = vector(first_dofs[n] + d);
    update_ghosts(field);
  }
} // namespace Touchstone
