// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/nodes_on_edges.h>

#include <algorithm>

// Slave nodes on edges of the master for pairings that know nothing of edges (doc/theory.md 4.2).
namespace Touchstone
{
  using namespace dealii;

  NodesOnEdges::NodesOnEdges(const PairingInput &input, const BeyondEdge beyond_edge)
    : input(input)
    , search(*input.master,
             2. * std::max(input.slave->largest_face(), input.master->largest_face()),
             input.parameters->edge_tolerance,
             MasterNormal::face,
             input.solid->communicator)
    , beyond_edge(beyond_edge)
    , edges(input)
  {
    search.commit(nullptr);
    for (const SurfaceNode &node : input.slave->owned_nodes())
      start.push_back(node.reference);
  }



  void
  NodesOnEdges::commit(const Vector &u)
  {
    search.commit(&u);
    const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
    for (std::size_t k = 0; k < nodes.size(); ++k)
      start[k] = input.slave->position(nodes[k], u);
    edges.commit();
  }



  void
  NodesOnEdges::update(const Vector &u, std::vector<ContactRow> &rows)
  {
    const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
    std::vector<std::size_t>        on_edges;
    std::vector<Point<dim>>         positions;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (EdgeOnEdge::at_sharp_edge(*input.slave, nodes[k].node))
        {
          on_edges.push_back(k);
          positions.push_back(input.slave->position(nodes[k], u));
        }
    search.update(positions);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      edges.clear(k);
    for (std::size_t i = 0; i < on_edges.size(); ++i)
      {
        const std::size_t k   = on_edges[i];
        ContactRow       &row = rows[k];
        SlavePoint        point;
        point.x          = positions[i];
        point.start      = start[k];
        point.in_contact = row.was_active;
        if (!edges.find(k, search, point, row.size, beyond_edge))
          continue;
        row.has_partner = true;
        row.stencil.clear();
        row.share = 1.;
        row.lever = Tensor<1, dim>();
        row.area  = nodes[k].area;
        row.away  = 0.;
        edges[k]->set(row);
      }
    if (edges.end_update(u))
      update(u, rows);
  }



  void
  NodesOnEdges::differentiate(std::vector<ContactRow> &rows)
  {
    std::vector<const Face *> needed;
    for (std::size_t k = 0; k < edges.size(); ++k)
      if (edges[k] && rows[k].was_active)
        edges[k]->add_faces(needed);
    const auto of_normals = search.normal_derivatives(needed);
    for (std::size_t k = 0; k < edges.size(); ++k)
      if (edges[k] && rows[k].was_active)
        edges[k]->differentiate(*input.slave, of_normals, rows[k]);
  }
} // namespace Touchstone
