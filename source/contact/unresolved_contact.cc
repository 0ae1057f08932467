#include <touchstone/contact/geometry/deformed_cells.h>
#include <touchstone/contact/geometry/edge_crossing.h>
#include <touchstone/contact/geometry/surface_cone.h>
#include <touchstone/contact/search/search.h>
#include <touchstone/contact/unresolved_contact.h>

#include <deal.II/base/mpi.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    using Box = BoundingBox<dim>;

    /** How deep sharp edges and vertices may reach into the other body, as a fraction of the
     * edge or the face: surfaces that are balanced with all their rows fit within less. */
    constexpr double deep_edge = 0.02;
    /** The same for a node of a smooth surface, which reaches into a coarser face by the
     * height of the arc over it before the nodes of that meet anything. */
    constexpr double deep_node = 0.1;
    /** Distance of edges that come close, as a fraction of the shorter one. */
    constexpr double near_edge = 0.1;
    /** Cosine between the normals of a face and of all faces around a node where that is no
     * node of a smooth surface. */
    constexpr double sharp_node = 0.9;
    /** Part of the force of the pair below which its direction does not matter. */
    constexpr double small_part = 0.1;
    /** Sine of the angle by which a force may lie outside the normals of the slave surface. */
    constexpr double oblique = 0.35;

    Box
    box_of(const SharpEdge &edge)
    {
      return Box(std::vector<Point<dim>>{edge.a, edge.b});
    }

    Tensor<1, dim>
    force_on(const Index node, const Vector &forces)
    {
      Tensor<1, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = forces(dim * node + d);
      return result;
    }

    /** Whether no node of a slave face carries a force. */
    bool
    idle(const Surface &slave, const Face &face, const Vector &forces)
    {
      const TraceBasis *basis = slave.trace(face);
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        if (force_on(basis ? basis->nodes[m] : face.nodes[m], forces).norm() > 0.)
          return false;
      return true;
    }

    double
    size_of(const Face &face)
    {
      return face.position(0).distance(face.position(face.n_nodes() - 1)) / std::sqrt(2.);
    }

    /** A place as a user reads it, without what is next to nothing. */
    std::string
    at(const Point<dim> &x)
    {
      constexpr double nothing = 1e-4;
      double           r[dim];
      for (unsigned int d = 0; d < dim; ++d)
        r[d] = std::abs(x[d]) > nothing * x.norm() ? x[d] : 0.;
      char text[80];
      std::snprintf(text, sizeof(text), "(%.3g, %.3g, %.3g)", r[0], r[1], r[2]);
      return text;
    }

    std::string
    number(const double value)
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
                                       const Vector                &forces)
    : solid(solid)
    , parameters(parameters)
    , slave(slave)
    , master(master)
    , slave_body(slave_body)
    , master_body(master_body)
    , u(u)
    , forces(forces)
  {
  }



  Search
  UnresolvedContact::search() const
  {
    std::vector<Point<dim>> corners;
    for (const Face &face : slave.owned_faces())
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        corners.push_back(face.position(m));
    Search result(master, slave.largest_face(), 0., MasterNormal::face, solid.communicator);
    result.update(corners);
    return result;
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
    const auto           tree = pack_rtree(boxes);
    std::vector<Overlap> result;
    for (const SharpEdge &edge : own)
      {
        const double length = edge.a.distance(edge.b);
        Box          box    = box_of(edge);
        box.extend(0.5 * length);
        namespace query = boost::geometry::index;
        for (const auto &entry : tree | query::adaptors::queried(query::intersects(box)))
          {
            const SharpEdge &other = others[entry.second];
            const double     least = least_depth * std::min(length, other.a.distance(other.b));
            const auto       found = edge_crossing(edge, other);
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
      {
        Box box({master_faces[i].position(0), master_faces[i].position(0)});
        for (unsigned int m = 1; m < master_faces[i].n_nodes(); ++m)
          box.merge_with(Box({master_faces[i].position(m), master_faces[i].position(m)}));
        boxes.emplace_back(box, i);
      }
    const auto           tree = pack_rtree(boxes);
    std::vector<Overlap> result;
    for (const Face &face : slave.owned_faces())
      {
        if (!idle(slave, face, forces))
          continue;
        const FaceGeometry   geometry(face, slave.exact_surface(face), MasterNormal::face);
        const Tensor<1, dim> normal = geometry.normal({{0., 0.}});
        const double         size   = size_of(face);
        Box                  box({face.position(0), face.position(0)});
        for (unsigned int m = 1; m < face.n_nodes(); ++m)
          box.merge_with(Box({face.position(m), face.position(m)}));
        box.extend(0.5 * size);
        namespace query = boost::geometry::index;
        for (const auto &entry : tree | query::adaptors::queried(query::intersects(box)))
          {
            const Face &other = master_faces[entry.second];
            for (unsigned int m = 0; m < other.n_nodes(); ++m)
              {
                const Point<dim> x     = other.position(m);
                const bool       sharp = other.own_normals[m] * other.edge_normals[m] < sharp_node;
                if (other.edge_normals[m] * normal >= 0. || !box.point_inside(x))
                  continue;
                const Projection foot = closest_point_projection(x, geometry);
                if (foot.beyond_inner > 0. || foot.beyond_outer > 0.)
                  continue;
                const FacePoint point = geometry.evaluate(foot.xi);
                const double    depth = (point.x - x) * point.normal();
                if (depth > (sharp ? deep_edge : deep_node) * size)
                  result.push_back({point.x, x, depth});
              }
          }
      }
    return result;
  }



  UnresolvedContact::Overlap
  UnresolvedContact::deepest(const std::vector<Overlap> &found, const bool edges) const
  {
    Overlap result{Point<dim>(), Point<dim>(), 0.};
    if (Utilities::MPI::max(found.size(), solid.communicator) == 0)
      return result;
    std::vector<std::array<double, 2 * dim + 1>> mine, all;
    for (const Overlap &o : found)
      mine.push_back(
        {{o.depth, o.slave[0], o.slave[1], o.slave[2], o.master[0], o.master[1], o.master[2]}});
    for (const auto &part : Utilities::MPI::all_gather(solid.communicator, mine))
      all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end(), std::greater<>());

    // Surfaces that see each other through a thin body overlap with nothing.
    const DeformedCells slave_cells(solid, slave_body, u), master_cells(solid, master_body, u);
    std::vector<int>    inside(all.size());
    for (std::size_t k = 0; k < all.size(); ++k)
      {
        const Point<dim> s(all[k][1], all[k][2], all[k][3]), m(all[k][4], all[k][5], all[k][6]);
        inside[k] = (slave_cells.contain(m) ? 1 : 0) + (edges && master_cells.contain(s) ? 2 : 0);
      }
    for (const int bit : {1, 2})
      {
        std::vector<int> bits;
        for (const int value : inside)
          bits.push_back(value & bit);
        Utilities::MPI::max(bits, solid.communicator, bits);
        for (std::size_t k = 0; k < all.size(); ++k)
          inside[k] |= bits[k];
      }
    for (std::size_t k = 0; k < all.size(); ++k)
      if (inside[k] == (edges ? 3 : 1))
        return {Point<dim>(all[k][1], all[k][2], all[k][3]),
                Point<dim>(all[k][4], all[k][5], all[k][6]),
                all[k][0]};
    return result;
  }



  std::string
  UnresolvedContact::oblique_force() const
  {
    double sum = 0.;
    for (const SurfaceNode &node : slave.owned_nodes())
      sum += force_on(node.node, forces).norm();
    sum = Utilities::MPI::sum(sum, solid.communicator);
    // Part of the force, and place.
    std::vector<double> worst;
    for (const SurfaceNode &node : slave.owned_nodes())
      {
        const double size = force_on(node.node, forces).norm();
        if (size == 0.)
          continue;
        const SurfaceCone cone(slave, node.node);
        Tensor<1, dim>    around;
        bool              largest = true;
        for (const Index other : cone.nodes())
          {
            around += force_on(other, forces);
            largest = largest && force_on(other, forces).norm() <= size;
          }
        // Beside a larger force the smaller one does not tell where the bodies touch.
        if (!largest || around.norm() < small_part * sum ||
            cone.distance(-1. * around / around.norm()) <= oblique)
          continue;
        const Point<dim> x = slave.position(node, u);
        if (worst.empty() || around.norm() > worst[0])
          worst = {around.norm(), x[0], x[1], x[2]};
      }
    for (const auto &other : Utilities::MPI::all_gather(solid.communicator, worst))
      if (worst.empty() || (!other.empty() && other > worst))
        worst = other;
    if (worst.empty())
      return "";
    const Point<dim> place(worst[1], worst[2], worst[3]);
    // Whether it is two edges that touch there.
    int          touch = 0;
    const Search found = search();
    for (const Overlap &crossing : crossing_edges(found.known_faces(), -near_edge))
      if (crossing.slave.distance(place) < slave.largest_face())
        touch = 1;
    const bool edges = Utilities::MPI::max(touch, solid.communicator) == 1;
    return "the contact force at " + at(place) + " is far from normal to the slave surface: an " +
           (edges ? "edge of '" : "edge or a vertex of '") + parameters.master_body + "' touches " +
           (edges ? "an edge of '" : "'") + parameters.slave_body + "' there";
  }



  std::string
  UnresolvedContact::overlap() const
  {
    const Search  found = search();
    const Overlap edges = deepest(crossing_edges(found.known_faces(), deep_edge), true);
    if (edges.depth > 0.)
      return "an edge of '" + parameters.slave_body + "' and an edge of '" +
             parameters.master_body + "' have passed through each other at " + at(edges.slave) +
             ", by " + number(edges.depth);
    const Overlap vertices = deepest(hidden_vertices(found.known_faces()), false);
    if (vertices.depth > 0.)
      return "a node of '" + parameters.master_body + "' at " + at(vertices.master) + " lies " +
             number(vertices.depth) + " within '" + parameters.slave_body +
             "', between slave nodes that touch nothing";
    return "";
  }



  std::string
  obstacle_within_face(const Solid                                     &solid,
                       const ContactPairParameters                     &parameters,
                       const Surface                                   &slave,
                       const Vector                                    &forces,
                       const std::function<double(const Point<dim> &)> &gap)
  {
    // Depth and place.
    std::vector<double> worst{0., 0., 0., 0.};
    for (const Face &face : slave.owned_faces())
      if (idle(slave, face, forces))
        for (const double a : {-0.5, 0., 0.5})
          for (const double b : {-0.5, 0., 0.5})
            {
              const Point<dim> x     = evaluate(face, slave.exact_surface(face), {{a, b}}).x;
              const double     depth = -gap(x);
              if (depth > deep_node * size_of(face) && depth > worst[0])
                worst = {depth, x[0], x[1], x[2]};
            }
    for (const auto &other : Utilities::MPI::all_gather(solid.communicator, worst))
      worst = std::max(worst, other);
    if (worst[0] == 0.)
      return "";
    return "the obstacle '" + parameters.obstacle + "' reaches " + number(worst[0]) + " into '" +
           parameters.slave_body + "' at " + at(Point<dim>(worst[1], worst[2], worst[3])) +
           ", between slave nodes that touch nothing";
  }
} // namespace Touchstone
