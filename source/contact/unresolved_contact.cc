// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/nodal_value.h>
#include <touchstone/base/exchange.h>
#include <touchstone/contact/entered_faces.h>
#include <touchstone/contact/geometry/deformed_cells.h>
#include <touchstone/contact/geometry/edge_crossing.h>
#include <touchstone/contact/geometry/surface_cone.h>
#include <touchstone/contact/place_in_words.h>
#include <touchstone/contact/search/face_exchange.h>
#include <touchstone/contact/tolerances.h>
#include <touchstone/contact/unresolved_contact.h>

#include <deal.II/base/mpi.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>

// Contact that no row of a slave node can describe (doc/theory.md 4.1): crossed edges, vertices of
// the master inside slave faces, and forces that are not normal to the slave surface. A converged
// step is checked for it, since Newton's method does not see it: the residual is zero while bodies
// overlap. Each finding is a sentence for the user, and the same on all ranks.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    using Box = BoundingBox<dim>;

    Box
    box_of(const SharpEdge &edge)
    {
      return Box(std::vector<Point<dim>>{edge.a, edge.b});
    }

    Box
    box_of(const Face &face)
    {
      std::vector<Point<dim>> positions;
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        positions.push_back(face.position(m));
      return Box(positions);
    }

    /** Whether no node of a slave face carries a force. */
    bool
    idle(const Surface &slave, const Face &face, const Vector &forces)
    {
      // A hanging node has no row; the force is on the nodes that it follows.
      const TraceBasis *basis = slave.trace(face);
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        if (nodal_value(forces, basis ? basis->nodes[m] : face.nodes[m]).norm() > 0.)
          return false;
      return true;
    }

    /** The part of a force along all of some planes, whose normals need not be orthogonal. */
    Tensor<1, dim>
    along_all(const std::vector<Tensor<1, dim>> &planes, Tensor<1, dim> force)
    {
      std::vector<Tensor<1, dim>> across;
      for (Tensor<1, dim> normal : planes)
        {
          for (const Tensor<1, dim> &other : across)
            normal -= (normal * other) * other;
          // The same plane again.
          if (normal.norm() < Tolerances::parallel_sine)
            continue;
          across.push_back(normal / normal.norm());
          force -= (force * across.back()) * across.back();
        }
      return force;
    }

    double
    size_of(const Face &face)
    {
      // The diagonal over the square root of two: the side of a square face.
      return face.position(0).distance(face.position(face.n_nodes() - 1)) / std::sqrt(2.);
    }

    std::string
    printed(const double value)
    {
      char text[20];
      std::snprintf(text, sizeof(text), "%.3g", value);
      return text;
    }
  } // namespace



  UnresolvedContact::UnresolvedContact(const Solid                 &solid,
                                       const ContactPairParameters &parameters,
                                       const Surface               &slave,
                                       const Surface               &master,
                                       const unsigned int           slave_body,
                                       const unsigned int           master_body,
                                       const Vector                &u,
                                       const Vector                &forces,
                                       const ContactPair::Mirrors  &mirrors)
    : solid(solid)
    , parameters(parameters)
    , slave(slave)
    , master(master)
    , slave_body(slave_body)
    , master_body(master_body)
    , u(u)
    , forces(forces)
    , mirrors(mirrors)
  {
  }



  std::vector<Face>
  UnresolvedContact::nearby_master_faces() const
  {
    // Boxes around all nodes of the slave faces decide which master faces are sent here.
    std::vector<Point<dim>> corners;
    for (const Face &face : slave.owned_faces())
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        corners.push_back(face.position(m));
    // The reach of one slave face: overlaps of interest are much less deep.
    FaceExchange exchange(master, slave.largest_face(), MasterNormal::face, solid.communicator);
    exchange.update(corners);
    return exchange.faces();
  }



  std::vector<UnresolvedContact::Overlap>
  UnresolvedContact::crossing_edges(const std::vector<Face> &master_faces,
                                    const double             least_depth) const
  {
    const std::vector<SharpEdge> own    = sharp_edges(slave.owned_faces(), slave.neighbour_faces()),
                                 others = sharp_edges(master_faces, {});
    std::vector<std::pair<Box, std::size_t>> boxes;
    for (std::size_t i = 0; i < others.size(); ++i)
      boxes.emplace_back(box_of(others[i]), i);
    // Master edges by their boxes, so that each slave edge meets only those nearby.
    const auto           tree = pack_rtree(boxes);
    std::vector<Overlap> result;
    for (const SharpEdge &edge : own)
      {
        const double length = edge.a.distance(edge.b);
        Box          box    = box_of(edge);
        // Edges may have passed each other by a part of their length and are still to be found.
        box.extend(0.5 * length);
        namespace query = boost::geometry::index;
        for (const auto &entry : tree | query::adaptors::queried(query::intersects(box)))
          {
            const SharpEdge &other = others[entry.second];
            // Depth as a fraction of the shorter edge: the check must not depend on the unit of
            // length.
            const double least = least_depth * std::min(length, other.a.distance(other.b));
            const auto   found = edge_crossing(edge, other);
            if (found && found->depth > least)
              result.push_back({found->first, found->second, found->depth});
          }
      }
    return result;
  }



  std::vector<UnresolvedContact::Overlap>
  UnresolvedContact::hidden_vertices(const std::vector<Face> &master_faces) const
  {
    std::vector<std::pair<Box, std::size_t>> boxes;
    for (std::size_t i = 0; i < master_faces.size(); ++i)
      boxes.emplace_back(box_of(master_faces[i]), i);
    const auto           tree = pack_rtree(boxes);
    std::vector<Overlap> result;
    for (const Face &face : slave.owned_faces())
      {
        // Where a node of the face carries a force, its row resists the penetration already.
        if (!idle(slave, face, forces))
          continue;
        Box box = box_of(face);
        box.extend(0.5 * size_of(face));
        namespace query = boost::geometry::index;
        for (const auto &entry : tree | query::adaptors::queried(query::intersects(box)))
          add_nodes_within(face, box, master_faces[entry.second], result);
      }
    return result;
  }



  void
  UnresolvedContact::add_nodes_within(const Face           &face,
                                      const Box            &box,
                                      const Face           &other,
                                      std::vector<Overlap> &found) const
  {
    const FaceGeometry   geometry(face, slave.exact_surface(face), MasterNormal::face);
    const Tensor<1, dim> normal = geometry.normal({{0., 0.}});
    for (unsigned int m = 0; m < other.n_nodes(); ++m)
      {
        const Point<dim> x = other.position(m);
        // The node must face the slave face; those of the far side of the master have normals along
        // it.
        if (other.edge_normals[m] * normal >= 0. || !box.point_inside(x))
          continue;
        // Depth is measured from the foot point on the slave face along its normal.
        const Projection foot = closest_point_projection(x, geometry);
        // The node belongs to a neighbouring face, or to none.
        if (foot.beyond_inner > 0. || foot.beyond_outer > 0.)
          continue;
        // A node of a smooth surface may reach into a coarser face by the sagitta of the arc (the
        // larger tolerance), a vertex may not.
        const bool sharp =
          other.own_normals[m] * other.edge_normals[m] < Tolerances::sharp_node_cosine;
        const FacePoint point = geometry.evaluate(foot.xi);
        const double    depth = (point.x - x) * point.normal();
        if (depth > (sharp ? Tolerances::deep_edge : Tolerances::deep_smooth_node) * size_of(face))
          found.push_back({point.x, x, depth});
      }
  }



  std::vector<UnresolvedContact::Overlap>
  UnresolvedContact::entering(const std::vector<Overlap> &found) const
  {
    std::vector<PointBehindFace> points;
    for (const Overlap &overlap : found)
      {
        const Tensor<1, dim> out = overlap.slave - overlap.master;
        points.push_back({overlap.master, out / out.norm(), overlap.depth});
      }
    const std::vector<bool> through = have_come_through(
      points,
      slave,
      u,
      [&](const Face &face) { return !idle(slave, face, forces); },
      solid.communicator);
    std::vector<Overlap> result;
    for (std::size_t k = 0; k < found.size(); ++k)
      if (through[k])
        result.push_back(found[k]);
    return result;
  }



  UnresolvedContact::Overlap
  UnresolvedContact::deepest(const std::vector<Overlap> &found, const bool edges) const
  {
    // The two sides of a thin body are near each other and seem to overlap with what touches one of
    // them: only points within the cells of the other body count.
    std::vector<Point<dim>>                of_master;
    std::vector<std::array<Point<dim>, 2>> of_both;
    for (const Overlap &overlap : found)
      {
        of_master.push_back(overlap.master);
        of_both.push_back({{overlap.slave, overlap.master}});
      }
    const std::vector<bool> inside =
      edges ? lie_within_each_other(of_both, solid, {{slave_body, master_body}}, u)
            : lie_within(of_master, solid, slave_body, u);
    // An order that does not depend on the partition.
    const auto deeper = [](const Overlap &a, const Overlap &b) {
      const auto key = [](const Overlap &o) {
        return std::make_tuple(
          o.depth, o.slave[0], o.slave[1], o.slave[2], o.master[0], o.master[1], o.master[2]);
      };
      return key(a) > key(b);
    };
    Overlap result{Point<dim>(), Point<dim>(), 0.};
    for (std::size_t k = 0; k < found.size(); ++k)
      if (inside[k] && deeper(found[k], result))
        result = found[k];
    for (const Overlap &overlap : gather_all(std::vector<Overlap>{result}, solid.communicator))
      if (deeper(overlap, result))
        result = overlap;
    return result;
  }



  namespace
  {
    /** The size of a force or a depth, with the position where it is. */
    struct Located
    {
      double     size = 0.;
      Point<dim> x;

      bool
      operator<(const Located &other) const
      {
        return std::make_tuple(size, x[0], x[1], x[2]) <
               std::make_tuple(other.size, other.x[0], other.x[1], other.x[2]);
      }
    };
  } // namespace



  std::string
  UnresolvedContact::oblique_force() const
  {
    double sum = 0.;
    // Forces on hanging nodes are on those that they follow, so owned nodes have all of the force.
    for (const SurfaceNode &node : slave.owned_nodes())
      sum += nodal_value(forces, node.node).norm();
    // Scale for what is a small force: the sum of the magnitudes over the pair.
    sum = Utilities::MPI::sum(sum, solid.communicator);
    std::vector<Located> oblique;
    for (const SurfaceNode &node : slave.owned_nodes())
      {
        const double size = nodal_value(forces, node.node).norm();
        if (size == 0.)
          continue;
        // Forces of neighbours are summed: on both sides of a sharp edge of the master each
        // of them is oblique and their sum is right (doc/theory.md 4.1).
        SurfaceCone    cone(slave, node.node);
        Tensor<1, dim> around;
        bool           largest = true;
        for (const Index other : cone.nodes())
          {
            around += nodal_value(forces, other);
            largest = largest && nodal_value(forces, other).norm() <= size;
          }
        // On a plane of symmetry what the mirrored half has is part of the sum, and cancels it
        // across the plane.
        if (const auto planes = mirrors.find(node.node); planes != mirrors.end())
          {
            around = along_all(planes->second, around);
            cone.mirror(planes->second);
          }
        // Only the largest force of a neighbourhood tells where the bodies touch.
        if (largest && around.norm() >= Tolerances::small_force * sum &&
            cone.distance(-1. * around / around.norm()) > Tolerances::oblique_sine)
          oblique.push_back({around.norm(), slave.position(node, u)});
      }
    // The one with the largest force (or depth), and among equal ones that with the largest
    // coordinates: the same on any partition.
    Located worst;
    for (const auto &part : gather_records(oblique, solid.communicator))
      for (const Located &force : part)
        worst = std::max(worst, force);
    if (worst.size == 0.)
      return "";
    const std::string far = "the contact force at " + place_in_words(worst.x) +
                            " is far from normal to the slave surface: ";
    const std::string &master_name = parameters.master_body, &slave_name = parameters.slave_body;
    switch (touching_at(worst.x))
      {
        case Feature::edges:
          return far + "an edge of '" + master_name + "' touches an edge of '" + slave_name +
                 "' there";
        case Feature::sharp:
          return far + "an edge or a vertex of '" + master_name + "' touches '" + slave_name +
                 "' there";
        default:
          return far + "the faces of '" + slave_name + "' there are so large that '" + master_name +
                 "' bends away from them by as much over one of them";
      }
  }



  UnresolvedContact::Feature
  UnresolvedContact::touching_at(const Point<dim> &x) const
  {
    const std::vector<Face> others = nearby_master_faces();
    int                     found  = static_cast<int>(Feature::smooth);
    for (const Face &face : others)
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        if (face.position(m).distance(x) < slave.largest_face() &&
            (face.own_normals[m] * face.edge_normals[m] < Tolerances::sharp_node_cosine ||
             at_end(face, m)))
          found = static_cast<int>(Feature::sharp);
    // Also edges that only come close, as a converged contact of rows leaves them: negative depth.
    // Every rank takes part, as the exchange of faces is collective.
    for (const Overlap &crossing : crossing_edges(others, -Tolerances::near_edge))
      if (crossing.slave.distance(x) < slave.largest_face())
        found = static_cast<int>(Feature::edges);
    return static_cast<Feature>(Utilities::MPI::max(found, solid.communicator));
  }



  std::string
  UnresolvedContact::overlap() const
  {
    const std::vector<Face> others = nearby_master_faces();
    // Each kind is reported by its deepest case.
    const Overlap edges = deepest(crossing_edges(others, Tolerances::deep_edge), /*edges=*/true);
    if (edges.depth > 0.)
      return "an edge of '" + parameters.slave_body + "' and an edge of '" +
             parameters.master_body + "' have passed through each other at " +
             place_in_words(edges.slave) + ", by " + printed(edges.depth);
    const Overlap vertices = deepest(entering(hidden_vertices(others)), /*edges=*/false);
    if (vertices.depth > 0.)
      return "a node of '" + parameters.master_body + "' at " + place_in_words(vertices.master) +
             " lies " + printed(vertices.depth) + " within '" + parameters.slave_body +
             "', between slave nodes that touch nothing";
    return "";
  }
} // namespace Touchstone
