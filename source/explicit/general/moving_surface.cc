// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/general/moving_surface.h>

#include <algorithm>
#include <cmath>

// The surfaces of candidates in a cycle. Of faces and nodes that the cycle has nothing to do with
// nothing is computed (doc/general_contact.md, section 2).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Relative, of sizes that are the same. */
    constexpr double round_off = 1e-9;
  } // namespace



  MovingSurface::MovingSurface(const ImpactSurface     &surface,
                               const NodeMap           &nodes,
                               const ContactCandidates &candidates)
    : insets(surface, nodes)
    , surface(surface)
    , nodes(nodes)
    , candidates(candidates)
  {
  }



  void
  MovingSurface::reinit()
  {
    motion.resize(candidates.at_slots.n());
    near_faces.clear();
    near_nodes.clear();
    face_is_near.assign(candidates.faces.size(), false);
    node_is_near.assign(motion.size(), false);
    local.resize(candidates.at_slots.n_owned());
    for (unsigned int node = 0; node < local.size(); ++node)
      local[node] = nodes.local(candidates.at_slots.dof(node));
  }



  void
  MovingSurface::clear()
  {
    for (const unsigned int face : near_faces)
      face_is_near[face] = false;
    for (const unsigned int node : near_nodes)
      node_is_near[node] = false;
    near_faces.clear();
    near_nodes.clear();
  }



  void
  MovingSurface::add_node(const std::size_t slot)
  {
    const unsigned int node = candidates.at_slots.node(slot);
    if (node_is_near[node])
      return;
    node_is_near[node] = true;
    near_nodes.push_back(node);
  }



  void
  MovingSurface::add_face(const unsigned int face)
  {
    if (face_is_near[face])
      return;
    face_is_near[face] = true;
    near_faces.push_back(face);
    for (unsigned int a = 0; a < 4; ++a)
      add_node(corner(face, a).slot);
  }



  void
  MovingSurface::import_node(const unsigned int node, const NodeField &u, const NodeField &v)
  {
    const unsigned int          of    = local[node];
    const InsetHistory::Insets &inner = insets.at(of);
    motion[node]                      = {surface.position(of, u),
                                         v[of],
                                         inner.now.normal,
                                         inner.before.normal,
                                         surface.size(of),
                                         inner.now.depth,
                                         inner.before.depth};
  }



  // Of other ranks it is not known what they need.
  void
  MovingSurface::import(const NodeField &u, const NodeField &v)
  {
    if (candidates.at_slots.alone())
      for (const unsigned int node : near_nodes)
        import_node(node, u, v);
    else
      {
        for (unsigned int node = 0; node < local.size(); ++node)
          import_node(node, u, v);
        candidates.at_slots.forward(motion);
      }
  }



  void
  MovingSurface::set_inner_positions(const double part)
  {
    inner_from.resize(motion.size());
    inner_to.resize(motion.size());
    for (const unsigned int node : near_nodes)
      {
        const NodeMotion &of = motion[node];
        inner_from[node]     = Point<dim>(of.x - part * of.depth_before * of.normal_before);
        inner_to[node]       = Point<dim>(of.x + cycle * of.v - part * of.depth * of.normal);
      }
    middle_from.resize(candidates.faces.size());
    middle_to.resize(candidates.faces.size());
    corners.resize(candidates.faces.size());
    std::array<Point<dim>, 4> x, y;
    for (const unsigned int face : near_faces)
      {
        Tensor<1, dim> from, to;
        double         largest = 0.;
        for (unsigned int a = 0; a < 4; ++a)
          {
            x[a] = inner_position(corner(face, a), false);
            y[a] = inner_position(corner(face, a), true);
            from += 0.25 * x[a];
            to += 0.25 * y[a];
            largest = std::max(largest, size(corner(face, a)));
          }
        middle_from[face] = Point<dim>(from);
        middle_to[face]   = Point<dim>(to);
        corners[face].set(x, y, largest);
      }
  }



  std::uint64_t
  MovingSurface::key(const SurfacePoint &point) const
  {
    // Keys of faces have room for a bit that those of nodes do not have.
    constexpr std::uint64_t of_middles = std::uint64_t(1) << 63;
    return point.middle ? candidates.faces[point.slot / 4].key | of_middles
                        : candidates.key(point.slot);
  }



  Tensor<1, dim>
  MovingSurface::mean(const SurfacePoint &point, Tensor<1, dim> NodeMotion::*const quantity) const
  {
    if (!point.middle)
      return at(point.slot).*quantity;
    Tensor<1, dim>    sum;
    const std::size_t first = point.slot - point.slot % 4;
    for (unsigned int a = 0; a < 4; ++a)
      sum += 0.25 * (at(first + a).*quantity);
    return sum;
  }



  MovingSurface::Edge
  MovingSurface::ends_of(const std::size_t edge) const
  {
    const std::size_t other = ContactCandidates::next(edge);
    const bool        first = candidates.key(edge) < candidates.key(other);
    return {{{first ? edge : other, false}, {first ? other : edge, false}}};
  }



  MovingSurface::TwoEdges
  MovingSurface::ends_of(const ContactCandidates::EdgePair &pair) const
  {
    const auto e = ends_of(pair.one), f = ends_of(pair.other);
    return {{e[0], e[1], f[0], f[1]}};
  }



  Tensor<1, dim>
  MovingSurface::outward(const TwoEdges &ends) const
  {
    return mean(ends[2], &NodeMotion::normal) + mean(ends[3], &NodeMotion::normal) -
           mean(ends[0], &NodeMotion::normal) - mean(ends[1], &NodeMotion::normal);
  }



  // The finer surface is the slave; where both are alike, the body or node that comes first.
  bool
  MovingSurface::is_slave(const std::size_t node, const unsigned int face) const
  {
    double other = 0.;
    for (unsigned int a = 0; a < 4; ++a)
      other += 0.25 * size(corner(face, a));
    const double own = at(node).size;
    if (std::abs(own - other) > round_off * other)
      return own < other;
    const ImpactFace &of = candidates.faces[node / 4], &to = candidates.faces[face];
    return of.body != to.body ? of.body < to.body : candidates.key(node) < to.nodes[0];
  }



  std::array<Point<dim>, 2>
  MovingSurface::inner_edge(const Edge &ends, const bool at_end) const
  {
    const Point<dim> begin = inner_position(ends[0], at_end), end = inner_position(ends[1], at_end);
    const Tensor<1, dim> more = tie * (end - begin);
    return {{begin - more, end + more}};
  }



  FourPoints
  MovingSurface::node_and_triangle(const SurfacePoint &node,
                                   const unsigned int  face,
                                   const unsigned int  triangle,
                                   const bool          at_end) const
  {
    FourPoints       x{{inner_position(node, at_end),
                        inner_position(corner(face, triangle), at_end),
                        inner_position(corner(face, triangle + 1), at_end),
                        inner_position(middle(face), at_end)}};
    const Point<dim> centre(1. / 3. * (x[1] + Tensor<1, dim>(x[2]) + x[3]));
    for (unsigned int i = 1; i < 4; ++i)
      x[i] += tie * (x[i] - centre);
    return x;
  }



  bool
  MovingSurface::is_warped(const unsigned int face) const
  {
    for (const bool at_end : {false, true})
      {
        std::array<Point<dim>, 4> x;
        for (unsigned int a = 0; a < 4; ++a)
          x[a] = inner_position(corner(face, a), at_end);
        const Tensor<1, dim> normal = cross_product_3d(x[2] - x[0], x[3] - x[1]);
        if (std::abs(normal * (x[0] - x[1] + x[2] - x[3])) >
            inset * at(4 * std::size_t(face)).depth * normal.norm())
          return true;
      }
    return false;
  }
} // namespace Touchstone
