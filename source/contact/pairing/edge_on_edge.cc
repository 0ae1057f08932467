// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/edge_on_edge.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <cmath>
#include <utility>

// Slave nodes of sharp edges that stand on sharp edges of the master (doc/theory.md 4.2, "Parallel
// edges"). In the plane across both edges each has the cone between the normals of its two faces;
// directions of both cones, those of the slave reversed, are what a contact force can have.
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
      return point.self == nullptr ||
             std::all_of(edge.faces.begin(), edge.faces.end(), [&](const Face *const face) {
               return point.self->may_meet(point, *face) &&
                      point.self->is_slave(point,
                                           *face,
                                           node_coordinates(*face, face->number_of(edge.nodes[0])));
             });
    }
  } // namespace



  bool
  EdgeOnEdge::at_sharp_edge(const Surface &slave, const Index node)
  {
    const auto around = slave.faces_around(node);
    // Edges of degree 2 are curved.
    if (around.front().first->degree > 1)
      return false;
    // Most nodes lie on smooth parts of a surface. What presses on an edge flattens it.
    for (const auto &[one, m] : around)
      for (const auto &[other, l] : around)
        {
          const Tensor<1, dim> first  = reference_area_vector(*one, m),
                               second = reference_area_vector(*other, l);
          if (one->own_normals[m] * other->own_normals[l] <= Tolerances::sharp_edge_cosine ||
              first * second <= Tolerances::sharp_edge_cosine * first.norm() * second.norm())
            return true;
        }
    return false;
  }



  EdgeOnEdge::EdgeOnEdge(const SharpEdge  &own,
                         const SharpEdge  &master,
                         const Index       node,
                         const Point<dim> &x,
                         const Reach      &reach)
    : slave(node)
    , other(own.nodes[own.nodes[0] == node ? 1 : 0])
    , slave_edge(own.nodes[0] == node ? own.a - own.b : own.b - own.a)
    , nodes(master.nodes)
    , edge(master.b - master.a)
    , edge_face(master.faces[0])
    , touch(cross_product_3d(edge, slave_edge).norm() <=
            Tolerances::parallel_sine * edge.norm() * slave_edge.norm())
    , reach(reach)
  {
    set_point(master, x);
    set_normal(own, master);
  }



  void
  EdgeOnEdge::set_point(const SharpEdge &master, const Point<dim> &x)
  {
    const double at = (x - master.a) * edge / edge.norm_square();
    along           = std::clamp(at, 0., 1.);
    free            = (at > 0. && at < 1.);
    beyond          = std::abs(at - along);
    distance        = x - master.a - along * edge;
    if (beyond <= Tolerances::on_edge)
      return;
    // The end of the master edge touches the slave edge between its nodes. Where it is close to the
    // other node, the row of that is enough.
    const double foot = 1. - distance * slave_edge / slave_edge.norm_square();
    if (foot >= 1. || (foot < Tolerances::least_share && !reach.stays))
      return;
    over_end = true;
    weight   = std::max(foot, Tolerances::least_share);
    free     = (foot == weight);
    beyond   = weight - foot;
    distance -= (1. - weight) * slave_edge;
  }



  // Angles in the plane across the master edge, from the middle between its two normals.
  void
  EdgeOnEdge::set_normal(const SharpEdge &own, const SharpEdge &master)
  {
    const Tensor<1, dim> t = edge / edge.norm();
    // The normals of both sides of either edge.
    std::array<Side, 4>           all;
    std::array<Tensor<1, dim>, 4> across;
    for (unsigned int k = 0; k < 4; ++k)
      {
        const bool  of_slave = (k >= 2);
        const Face &face     = *(of_slave ? own : master).faces[k % 2];
        Side       &side     = all[k];
        side.face            = &face;
        side.sign            = (of_slave ? -1. : 1.);
        side.corners         = {{face.number_of(of_slave ? slave : nodes[0]),
                                 face.number_of(of_slave ? other : nodes[1])}};
        side.weights         = {{of_slave ? weight : 1. - along, of_slave ? 1. - weight : along}};
        side.normal          = side.sum_of_normals();
        side.normal /= side.normal.norm();
        across[k] = side.normal - (side.normal * t) * t;
        across[k] /= across[k].norm();
      }
    Tensor<1, dim> up = across[0] + across[1];
    up /= up.norm();
    const Tensor<1, dim> aside = cross_product_3d(t, up);
    const auto angle = [&](const Tensor<1, dim> &v) { return std::atan2(v * aside, v * up); };
    // The two cones as numbers of their normals with the smaller and the larger angle.
    std::array<double, 4> angles;
    for (unsigned int k = 0; k < 2; ++k)
      angles[k] = angle(across[k]);
    const double middle = angle(across[2] + across[3]);
    const double half   = 0.5 * std::acos(std::clamp(across[2] * across[3], -1., 1.));
    const bool   second = cross_product_3d(across[2], across[3]) * t > 0.;
    angles[2]           = middle + (second ? -half : half);
    angles[3]           = middle + (second ? half : -half);
    const auto least = [&](const unsigned int k) { return angles[k] < angles[k + 1] ? k : k + 1; };
    const auto most  = [&](const unsigned int k) { return angles[k] < angles[k + 1] ? k + 1 : k; };
    const unsigned int from = angles[least(0)] > angles[least(2)] ? least(0) : least(2),
                       to   = angles[most(0)] < angles[most(2)] ? most(0) : most(2);
    // What fits is contact of faces, which rows of nodes describe: the cones just meet. One that
    // lies within the other may be as narrow as it is, of an edge that has been pressed flat.
    const double common = angles[to] - angles[from];
    if (common < 0. || (common < Tolerances::edges_touch && (from < 2) != (to < 2)))
      touch = false;
    sides  = {{all[from], all[to]}};
    normal = all[from].normal + all[to].normal;
    normal /= normal.norm();
  }



  double
  EdgeOnEdge::beside() const
  {
    return (distance - (distance * normal) * normal).norm();
  }



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



  bool
  EdgeOnEdge::stands() const
  {
    return touch && beyond <= Tolerances::edge_hysteresis * reach.edge_tolerance &&
           beside() <= Tolerances::touching * reach.size;
  }



  bool
  EdgeOnEdge::holds(const Point<dim> &start, const bool swept) const
  {
    const double gap = distance * normal;
    // Beside the edge it is a face that is touched. An iterate may carry the node deep into the
    // body, where the face that is closest would be decided by how it got there.
    if (!reach.stays && (!touch || beyond > reach.edge_tolerance ||
                         std::abs(gap) > Tolerances::onto_edge * reach.size ||
                         beside() > Tolerances::touching * reach.size +
                                      Tolerances::beside_edge * std::max(0., -gap)))
      return false;
    // What was behind the edge before is the other side of a thin body.
    return !swept || gap >= 0. ||
           distance_at_start(start) * normal > -Tolerances::deep_edge * reach.size;
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
            if (!found.holds(point.start, search.exchange().swept()))
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



  // With the weight W of the slave node at the point of contact all of the row is divided by W, as
  // in (30).
  void
  EdgeOnEdge::set(ContactRow &row) const
  {
    const auto add = [&row](const Index node, const double w) {
      if (std::abs(w) > Tolerances::negligible_weight)
        row.stencil.push_back({node, w});
    };
    add(nodes[0], (1. - along) / weight);
    add(nodes[1], along / weight);
    if (over_end)
      add(other, 1. - 1. / weight);
    row.normal     = normal;
    row.share      = 1. / weight;
    row.lever      = (weight - 1.) * slave_edge;
    row.area       = weight * row.area;
    row.gap_vector = distance / weight;
    row.gap        = row.gap_vector * normal;
  }
} // namespace Touchstone
