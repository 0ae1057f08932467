// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/edge_on_edge.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <cmath>
#include <utility>

// Which edge of the master a slave node stands on (doc/theory.md 4.2, "Parallel edges").
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    bool
    has(const SharpEdge &edge, const Index node)
    {
      return edge.nodes[0] == node || edge.nodes[1] == node;
    }

    /** The sharp edges in which two faces of the slave meet at a node. */
    std::vector<SharpEdge>
    edges_at(const Surface &slave, const Index node)
    {
      if (!EdgeOnEdge::at_sharp_edge(slave, node))
        return {};
      std::vector<const Face *> faces;
      for (const auto &[face, m] : slave.faces_around(node))
        faces.push_back(face);
      std::vector<SharpEdge> result = sharp_edges(faces, Tolerances::sharp_edge_cosine);
      result.erase(std::remove_if(result.begin(),
                                  result.end(),
                                  [&](const SharpEdge &edge) {
                                    return edge.faces[1] == nullptr || !has(edge, node);
                                  }),
                   result.end());
      return result;
    }

    /** Whether a node can stand on an edge of the master: of the own body as SelfContact says. */
    bool
    may_stand_on(const SlavePoint &point, const SharpEdge &edge)
    {
      if (edge.faces[1] == nullptr)
        return false;
      if (point.self == nullptr)
        return true;
      // Who is the slave is asked of the closest point of the edge, the same of both faces, but for
      // faces that the node does not face where both touch as they are made.
      const auto may_meet = [&](const Face *const face) {
        return point.self->may_meet(point, *face);
      };
      const auto is_slave = [&](const Face *const face) {
        const std::array<unsigned int, 2> ends = {
          {face->number_of(edge.nodes[0]), face->number_of(edge.nodes[1])}};
        const Point<dim>    &first = face->reference[ends[0]];
        const Tensor<1, dim> along = face->reference[ends[1]] - first;
        const double         s =
          std::clamp((point.reference - first) * along / along.norm_square(), 0., 1.);
        std::array<double, 2> xi    = node_coordinates(*face, ends[0]),
                              other = node_coordinates(*face, ends[1]);
        for (unsigned int a = 0; a < 2; ++a)
          xi[a] += s * (other[a] - xi[a]);
        return point.self->is_slave(point, *face, xi);
      };
      return std::all_of(edge.faces.begin(), edge.faces.end(), may_meet) &&
             std::any_of(edge.faces.begin(), edge.faces.end(), is_slave);
    }
  } // namespace



  Tensor<1, dim>
  EdgeOnEdge::distance_at_start(const Point<dim> &start) const
  {
    std::array<Point<dim>, 2> x;
    for (unsigned int k = 0; k < 2; ++k)
      {
        const unsigned int m = edge_face->number_of(nodes[k]);
        x[k]                 = edge_face->reference[m] + edge_face->committed[m];
      }
    const Tensor<1, dim> t = (x[1] - x[0]) / (x[1] - x[0]).norm(), from_end = start - x[0];
    return from_end - (from_end * t) * t;
  }



  // With the direction from the edge to the node for its normal the force would leave the cone of
  // the slave's normals, and its direction would be what the last digits of the position say.
  bool
  EdgeOnEdge::holds_beyond(const SlavePoint &point) const
  {
    if (reach.beyond_edge == BeyondEdge::free || !fits() || over_end)
      return false;
    const double         touches  = Tolerances::touches_at_start * reach.size;
    const Tensor<1, dim> at_start = distance_at_start(point.start);
    const bool           was_on   = at_start * outward <= touches;
    // What comes along the other face of the edge, with a clearance, is not held by it.
    if (!reach.touched && !was_on)
      return false;
    const bool   stays     = reach.touched || (was_on && std::abs(at_start * normal) <= touches);
    const double tolerance = (stays ? Tolerances::edge_hysteresis : 1.) * reach.edge_tolerance;
    const double aside     = distance * outward;
    // A node that sticks on the edge must not go from face to edge and back by round-off.
    return beyond <= tolerance && aside > -Tolerances::in_wedge * width &&
           aside <= tolerance * width &&
           std::abs(distance * normal) <= Tolerances::onto_edge * reach.size;
  }



  bool
  EdgeOnEdge::holds(const SlavePoint &point, const bool swept) const
  {
    const double gap = distance * normal;
    // Beside the edge it is a face that is touched. An iterate may carry the node deep into the
    // body, where the face that is closest would be decided by how it got there.
    if (!reach.stays && !holds_beyond(point) &&
        (!touch || beyond > reach.edge_tolerance ||
         std::abs(gap) > Tolerances::onto_edge * reach.size ||
         beside() >
           Tolerances::touching * reach.size + Tolerances::beside_edge * std::max(0., -gap)))
      return false;
    // What was behind the edge before is the other side of a thin body, or an initial overlap.
    return !swept || gap >= 0. || reach.overlaps ||
           distance_at_start(point.start) * normal > -Tolerances::deep_edge * reach.size;
  }



  int
  EdgeOnEdge::better_than(const EdgeOnEdge &best, const Point<dim> &start) const
  {
    // A node that stays does so on the line of edges that it stood on, even if an iterate is closer
    // to another one.
    const double at_start =
      reach.stays ? distance_at_start(start).norm() - best.distance_at_start(start).norm() : 0.;
    if (std::abs(at_start) > 0.5 * reach.size)
      return at_start < 0. ? 1 : -1;
    if (touch != best.touch)
      return touch ? 1 : -1;
    // Where an edge goes on in another one it has no end: that of the last one is closest.
    const auto kind = [](const EdgeOnEdge &one) {
      return one.over_end ? 1 : one.beyond > Tolerances::on_edge ? 2 : 0;
    };
    if (kind(*this) != kind(best))
      return kind(*this) < kind(best) ? 1 : -1;
    if (over_end && std::abs(weight - best.weight) > Tolerances::on_edge)
      return weight > best.weight ? 1 : -1;
    // Edges that go on in each other at a node are equally close.
    const double closer = best.distance.norm() - distance.norm();
    if (std::abs(closer) < Tolerances::on_edge * reach.size)
      return 0;
    return closer > 0. ? 1 : -1;
  }



  std::optional<EdgeOnEdge>
  EdgeOnEdge::find(const Surface    &slave,
                   const Search     &search,
                   const SlavePoint &point,
                   const Index       node,
                   const Reach      &reach)
  {
    const std::vector<SharpEdge> own = edges_at(slave, node);
    if (own.empty())
      return {};
    std::vector<std::pair<double, std::size_t>> boxes;
    search.tree().within(point.x, Tolerances::onto_edge * reach.size, boxes);
    std::vector<const Face *> near;
    for (const auto &[square, i] : boxes)
      near.push_back(&search.exchange().faces()[i]);
    std::optional<EdgeOnEdge> result;
    std::uint64_t             key = 0;
    for (const SharpEdge &master : sharp_edges(near, Tolerances::sharp_edge_cosine))
      if (may_stand_on(point, master))
        for (const SharpEdge &edge : own)
          {
            const EdgeOnEdge found(edge, master, node, point.x, reach);
            if (!found.holds(point, search.exchange().swept()))
              continue;
            const int better = result ? found.better_than(*result, point.start) : 1;
            if (better > 0 || (better == 0 && master.key < key))
              {
                result = found;
                key    = master.key;
              }
          }
    return result;
  }
} // namespace Touchstone
