// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/edge_on_edge.h>
#include <touchstone/contact/pairing/row_derivative.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/symmetric_tensor.h>

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



  Tensor<1, dim>
  EdgeOnEdge::sum_of_normals(const Side &side) const
  {
    return side.sign * ((1. - along) * side.face->normals[side.corners[0]] +
                        along * side.face->normals[side.corners[1]]);
  }



  // Angles in the plane across the master edge, from the middle between its two normals.
  EdgeOnEdge
  EdgeOnEdge::on_edge(const SharpEdge  &own,
                      const SharpEdge  &other,
                      const Index       node,
                      const Point<dim> &x)
  {
    EdgeOnEdge           result;
    const Tensor<1, dim> e = other.b - other.a, own_edge = own.b - own.a;
    result.touch = cross_product_3d(e, own_edge).norm() <=
                   Tolerances::parallel_sine * e.norm() * own_edge.norm();
    result.nodes           = other.nodes;
    result.edge            = e;
    result.edge_face       = other.faces[0];
    const double at        = (x - other.a) * e / e.norm_square();
    result.along           = std::clamp(at, 0., 1.);
    result.free            = (at > 0. && at < 1.);
    result.distance        = x - other.a - result.along * e;
    const Tensor<1, dim> t = e / e.norm();
    result.beyond          = std::abs(at - result.along);

    // The normals of both sides of either edge.
    std::array<Side, 4>           all;
    std::array<Tensor<1, dim>, 4> across;
    for (unsigned int k = 0; k < 4; ++k)
      {
        const bool  of_slave = (k >= 2);
        const Face &face     = *(of_slave ? own : other).faces[k % 2];
        Side       &side     = all[k];
        side.face            = &face;
        side.sign            = (of_slave ? -1. : 1.);
        side.corners         = {{face.number_of(of_slave ? node : other.nodes[0]),
                                 face.number_of(of_slave ? node : other.nodes[1])}};
        side.normal          = result.sum_of_normals(side);
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
      result.touch = false;
    result.sides  = {{all[from], all[to]}};
    result.normal = all[from].normal + all[to].normal;
    result.normal /= result.normal.norm();
    return result;
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
    const double gap = distance * normal, size = reach.size;
    // Beside the edge it is a face that is touched. An iterate may carry the node deep into the
    // body, where the face that is closest would be decided by how it got there.
    if (!reach.stays &&
        (!touch || beyond > reach.edge_tolerance || std::abs(gap) > Tolerances::onto_edge * size ||
         beside() > Tolerances::touching * size + Tolerances::beside_edge * std::max(0., -gap)))
      return false;
    // What was behind the edge before is the other side of a thin body.
    if (!swept || gap >= 0.)
      return true;
    Tensor<1, dim> before = start - Point<dim>();
    for (unsigned int k = 0; k < 2; ++k)
      {
        const unsigned int m = edge_face->number_of(nodes[k]);
        before -= (k == 0 ? 1. - along : along) *
                  (edge_face->reference[m] + edge_face->committed[m] - Point<dim>());
      }
    return before * normal > -Tolerances::deep_edge * size;
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
    for (const SharpEdge &other : sharp_edges(near, Tolerances::sharp_edge_cosine))
      if (may_stand_on(point, other))
        for (const SharpEdge &edge : own)
          {
            EdgeOnEdge found = on_edge(edge, other, node, point.x);
            found.reach      = reach;
            if (!found.holds(point.start, search.exchange().swept()))
              continue;
            const double difference =
              result ? found.distance.norm() - result->distance.norm() : -reach.size;
            // Edges that go on in each other at a node are equally close.
            const bool same = std::abs(difference) < Tolerances::on_edge * reach.size;
            if (same ? other.key < key : difference < 0.)
              {
                result = found;
                key    = other.key;
              }
          }
    return result;
  }



  void
  EdgeOnEdge::set(ContactRow &row) const
  {
    for (unsigned int k = 0; k < 2; ++k)
      if (const double weight = (k == 0 ? 1. - along : along);
          weight > Tolerances::negligible_weight)
        row.stencil.push_back({nodes[k], weight});
    row.normal     = normal;
    row.gap_vector = distance;
    row.gap        = distance * normal;
  }



  void
  EdgeOnEdge::add_faces(std::vector<const Face *> &faces) const
  {
    for (const Side &side : sides)
      if (side.sign > 0.)
        faces.push_back(side.face);
  }



  // d = x - y_0 - a e with d.e = 0 gives da; the normal is the direction of the sum of two unit
  // vectors.
  void
  EdgeOnEdge::differentiate(const Surface   &slave,
                            const OfNormals &of_normals,
                            ContactRow      &row) const
  {
    // Where the node stands on an end of the edge, the weight of the other end is zero but changes.
    for (const Index node : nodes)
      if (std::none_of(row.stencil.begin(), row.stencil.end(), [node](const auto &entry) {
            return entry.node == node;
          }))
        row.stencil.push_back({node, 0.});
    RowDerivativeBuilder builder(row.stencil.size());
    RowDerivative       &result = *builder.result;
    const Tensor<2, dim> turn   = normalisation_derivative(sides[0].normal + sides[1].normal);
    std::array<Tensor<2, dim>, 2> by_side;
    Tensor<1, dim>                by_along;
    for (unsigned int k = 0; k < 2; ++k)
      {
        const Side &side = sides[k];
        by_side[k]       = side.sign * (turn * normalisation_derivative(sum_of_normals(side)));
        by_along +=
          by_side[k] * (side.face->normals[side.corners[1]] - side.face->normals[side.corners[0]]);
      }
    const Tensor<2, dim> identity(unit_symmetric_tensor<dim>());
    // Of each node with unit motion the motion of d at a fixed foot, and of e.
    const Index  moved[3]   = {row.slave, nodes[0], nodes[1]};
    const double at_foot[3] = {1., along - 1., -along}, of_edge[3] = {0., -1., 1.};
    for (unsigned int k = 0; k < 3; ++k)
      {
        Tensor<1, dim> da;
        if (free)
          da = (at_foot[k] * edge + of_edge[k] * distance) / edge.norm_square();
        const std::size_t i = builder.index(moved[k]);
        result.gap_vector[i] += at_foot[k] * identity - outer_product(edge, da);
        result.normal[i] += outer_product(by_along, da);
        for (std::size_t m = 0; m < row.stencil.size(); ++m)
          result.weights[m][i] += (row.stencil[m].node == nodes[0] ? -1. : 1.) * da;
      }
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int end = 0; end < 2; ++end)
        {
          const Side          &side   = sides[k];
          const Tensor<2, dim> by_end = (end == 0 ? 1. - along : along) * by_side[k];
          if (side.sign < 0.)
            {
              for (const auto &[node, value] :
                   slave.normal_derivative(slave.normal_shares(*side.face, side.corners[end])))
                result.normal[builder.index(node)] += by_end * value;
            }
          else if (const auto found = of_normals.find(side.face); found != of_normals.end())
            for (const NormalDerivative &d : found->second)
              if (d.m == side.corners[end])
                result.normal[builder.index(d.node)] += by_end * d.value;
        }
    row.derivative = builder.result;
  }
} // namespace Touchstone
