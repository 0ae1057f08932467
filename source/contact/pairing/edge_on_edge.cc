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
    if (beyond > Tolerances::on_edge && (reach.stays || !fits()))
      {
        set_point_over_end();
        set_normal(own, master);
      }
  }



  void
  EdgeOnEdge::set_point(const SharpEdge &master, const Point<dim> &x)
  {
    const double at = (x - master.a) * edge / edge.norm_square();
    along           = std::clamp(at, 0., 1.);
    free            = (at > 0. && at < 1.);
    beyond          = std::abs(at - along);
    distance        = x - master.a - along * edge;
  }



  void
  EdgeOnEdge::set_point_over_end()
  {
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
    const double common   = angles[to] - angles[from];
    const bool   parallel = touch || fits(), different = (from < 2) != (to < 2);
    if (common < 0. || (common < Tolerances::edges_touch && different))
      touch = false;
    sides   = {{all[from], all[to]}};
    outward = Tensor<1, dim>();
    if (reach.beyond_edge != BeyondEdge::free && !reach.stays && parallel && different &&
        std::abs(common) < Tolerances::edges_touch)
      {
        const unsigned int of_master = std::min(from, to), of_slave = std::max(from, to);
        const Side        &side =
          all[reach.beyond_edge == BeyondEdge::along_slave_normal ? of_slave : of_master];
        sides   = {{side, side}};
        outward = all[1 - of_master].normal;
        outward -= (outward * side.normal) * side.normal;
        outward /= outward.norm();
        const Face &face = *all[of_master].face;
        Point<dim>  centre;
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          centre += face.position(m) / face.n_nodes();
        width = 2. * std::abs((centre - master.a) * outward);
      }
    normal = sides[0].normal + sides[1].normal;
    normal /= normal.norm();
  }



  double
  EdgeOnEdge::beside() const
  {
    return (distance - (distance * normal) * normal).norm();
  }



  bool
  EdgeOnEdge::stands() const
  {
    return touch && beyond <= Tolerances::edge_hysteresis * reach.edge_tolerance &&
           beside() <= Tolerances::touching * reach.size;
  }



  bool
  EdgeOnEdge::may_stay() const
  {
    const double gap = distance * normal;
    return stands() && (gap <= Tolerances::touches_at_start * reach.size ||
                        beside() <= Tolerances::beside_edge * gap);
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
