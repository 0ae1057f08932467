// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/edge_search.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <cmath>

// Where edges and vertices touch between slave nodes (doc/theory.md 4.2): the faces that each rank
// looks at, and which of the nodes has the row. Each rank looks at edges and faces at its own
// nodes, of which it knows all that decides, so that all ranks at an edge or face find the same.
// Which of the nodes has the row is decided by the start of the step: within a step it does not
// change from one Newton iterate to the next. What is looked for is in edges_that_cross.cc and
// vertices_in_faces.cc.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A number that identifies a key, not zero, which a vector of displacements can carry. */
    double
    in_a_double(const std::uint64_t key)
    {
      return 1. + ((key ^ (key >> 11)) & ((std::uint64_t(1) << 52) - 1));
    }
  } // namespace


  EdgeSearch::EdgeSearch(const PairingInput &input)
    : solid(*input.solid)
    , slave(*input.slave)
    // All faces are needed that are around a node within two edges of a slave node.
    , slave_exchange(slave,
                     2. * std::max(input.slave->largest_face(), input.master->largest_face()),
                     MasterNormal::averaged,
                     input.solid->communicator)
    , exchange(*input.master,
               2. * std::max(input.slave->largest_face(), input.master->largest_face()),
               MasterNormal::face,
               input.solid->communicator)
  {
    commit(nullptr);
    for (const SurfaceNode &node : slave.owned_nodes())
      start[node.node] = node.reference;
  }



  void
  EdgeSearch::commit(const Vector *u)
  {
    slave_exchange.commit(u);
    exchange.commit(u);
    for (const SurfaceNode &node : slave.owned_nodes())
      if (u != nullptr)
        start[node.node] = slave.position(node, *u);
  }



  void
  EdgeSearch::exchange_faces(const Vector &u)
  {
    std::vector<Point<dim>> positions;
    for (const SurfaceNode &node : slave.owned_nodes())
      {
        positions.push_back(slave.position(node, u));
        positions.push_back(start.at(node.node));
      }
    slave_exchange.update(positions);
    exchange.update(positions);
    around.clear();
    for (const Face &face : exchange.faces())
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        around[face.nodes[m]].emplace_back(&face, m);
    for (const FaceExchange *const faces : {&slave_exchange, &exchange})
      for (const Face &face : faces->faces())
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          start[face.nodes[m]] = face.reference[m] + face.committed[m];
  }



  std::vector<FoundBetweenNodes>
  EdgeSearch::find(const Vector &u)
  {
    exchange_faces(u);
    std::vector<FoundBetweenNodes> found;
    if (!slave_exchange.faces().empty() && !exchange.faces().empty())
      {
        find_edges(found);
        find_vertices(found);
      }
    // Faces are large, and nothing refers to them if nothing was found.
    if (Utilities::MPI::max(static_cast<int>(!found.empty()), solid.communicator) == 0)
      {
        around.clear();
        slave_exchange.forget();
        exchange.forget();
      }
    return found;
  }



  bool
  EdgeSearch::owned(const std::vector<Index> &nodes) const
  {
    return std::any_of(nodes.begin(), nodes.end(), [&](const Index node) {
      return solid.owned.is_element(dim * node);
    });
  }



  void
  EdgeSearch::hold(const std::vector<std::pair<Index, std::uint64_t>> &keys)
  {
    // Most problems have no such rows, and a vector over all dofs is large.
    held.clear();
    if (Utilities::MPI::max(static_cast<int>(!keys.empty()), solid.communicator) == 0)
      return;
    Vector owned_part(solid.zero_vector());
    for (const auto &[node, key] : keys)
      owned_part(dim * node) = in_a_double(key);
    owned_part.compress(VectorOperation::insert);
    held = solid.ghosted(owned_part);
  }



  bool
  EdgeSearch::is_held(const Index node, const std::uint64_t key) const
  {
    return held.size() > 0 && held(dim * node) == in_a_double(key);
  }



  unsigned int
  EdgeSearch::node_of_row(const std::vector<Index>  &nodes,
                          const std::uint64_t        key,
                          const std::vector<double> &weights,
                          const std::vector<double> &before) const
  {
    const auto largest = [&](const std::vector<double> &by) {
      unsigned int result = numbers::invalid_unsigned_int;
      for (unsigned int k = 0; k < nodes.size(); ++k)
        {
          // A hanging node has no row.
          if (solid.hanging.is_constrained(dim * nodes[k]))
            continue;
          const bool first = result == numbers::invalid_unsigned_int;
          // Of equal ones, as in the middle, the first in space: numbers depend on the partition.
          const bool equal = !first && std::abs(by[k] - by[result]) < Tolerances::edge_end;
          if (first || (equal ? std::lexicographical_compare(start.at(nodes[k]).begin_raw(),
                                                             start.at(nodes[k]).end_raw(),
                                                             start.at(nodes[result]).begin_raw(),
                                                             start.at(nodes[result]).end_raw())
                              : by[k] > by[result]))
            result = k;
        }
      return result;
    };
    unsigned int chosen = largest(before);
    for (unsigned int k = 0; k < nodes.size(); ++k)
      if (is_held(nodes[k], key))
        chosen = k;
    return chosen == numbers::invalid_unsigned_int || weights[chosen] > Tolerances::least_share
             ? chosen
             : largest(weights);
  }
} // namespace Touchstone
