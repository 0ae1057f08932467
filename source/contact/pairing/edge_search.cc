// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/face_geometry.h>
#include <touchstone/contact/pairing/edge_contact.h>
#include <touchstone/contact/pairing/edge_search.h>
#include <touchstone/contact/pairing/vertex_contact.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>

// Where edges and vertices touch between slave nodes (doc/theory.md 4.2). Each rank looks at edges
// and faces at its own nodes, of which it knows all that decides, so that all ranks at an edge or
// face find the same. Which of the nodes has the row is decided by the start of the step: within a
// step it does not change from one Newton iterate to the next.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    using Box = BoundingBox<dim>;

    Box
    box_of(const Face &face)
    {
      std::vector<Point<dim>> positions;
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        positions.push_back(face.position(m));
      return Box(positions);
    }

    /** A number that identifies a key, not zero, which a vector of displacements can carry. */
    double
    in_a_double(const std::uint64_t key)
    {
      return 1. + ((key ^ (key >> 11)) & ((std::uint64_t(1) << 52) - 1));
    }

    /** Whether a node of faces of degree 1 lies on a sharp edge of the body as it was made, or
     * where the surface ends. What presses on it flattens it. @param corners Faces around it, and
     * its number there. */
    bool
    on_sharp_edge(const std::vector<std::pair<const Face *, unsigned int>> &corners)
    {
      std::vector<Tensor<1, dim>> normals;
      Tensor<1, dim>              mean;
      for (const auto &[face, m] : corners)
        {
          const unsigned int edges = (m & 1u ? 2u : 1u) | (m & 2u ? 8u : 4u);
          if ((face->outer_edges & edges) != 0)
            return true;
          const double sign = (m == 0 || m == 3) ? 1. : -1.;
          normals.push_back(sign * cross_product_3d(face->reference[m ^ 1u] - face->reference[m],
                                                    face->reference[m ^ 2u] - face->reference[m]));
          mean += normals.back();
        }
      return std::any_of(normals.begin(), normals.end(), [&](const Tensor<1, dim> &normal) {
        return normal * mean < Tolerances::sharp_node_cosine * normal.norm() * mean.norm();
      });
    }

    /** Along the first of two lines, from a to b as 0 to 1, the foot of their common perpendicular,
     * within the edge; @p otherwise if they are parallel. */
    double
    foot(const Point<dim> (&first)[2], const Point<dim> (&second)[2], const double otherwise)
    {
      const Tensor<1, dim> d = first[1] - first[0], e = second[1] - second[0],
                           n = cross_product_3d(d, e);
      if (n.norm() <= Tolerances::parallel_sine * d.norm() * e.norm())
        return otherwise;
      const double s = cross_product_3d(second[0] - first[0], e) * n / n.norm_square();
      return std::clamp(s, 0., 1.);
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
    Vector owned_part(solid.owned, solid.communicator);
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



  namespace
  {
    /** The sharp edges of faces with the directions of the lines that they make. */
    std::vector<EdgeOfLine>
    lines_of_edges(const std::vector<Face> &faces)
    {
      const std::vector<SharpEdge> edges = sharp_edges(faces, {}, Tolerances::along_normal_cosine);
      std::unordered_multimap<Index, std::size_t> at_nodes;
      for (std::size_t i = 0; i < edges.size(); ++i)
        for (const Index node : edges[i].nodes)
          at_nodes.emplace(node, i);
      std::vector<EdgeOfLine> result;
      for (const SharpEdge &edge : edges)
        {
          result.push_back({edge, {}});
          const Tensor<1, dim> along = edge.b - edge.a;
          for (unsigned int end = 0; end < 2; ++end)
            {
              // Where one other edge goes on from here, the mean of both.
              EdgeTangent &tangent = result.back().tangents[end];
              tangent              = {along, {{edge.nodes[1], 1.}, {edge.nodes[0], -1.}}};
              unsigned int n       = 0;
              const auto   range   = at_nodes.equal_range(edge.nodes[end]);
              for (auto entry = range.first; entry != range.second; ++entry)
                {
                  const SharpEdge &next = edges[entry->second];
                  if (&next == &edge)
                    continue;
                  const unsigned int   from = (next.nodes[0] == edge.nodes[end] ? 0 : 1);
                  const Tensor<1, dim> on =
                    ((from == 0) == (end == 1) ? 1. : -1.) * (next.b - next.a);
                  if (on * along < Tolerances::edge_goes_on * on.norm() * along.norm())
                    continue;
                  ++n;
                  const Index  far = next.nodes[1 - from], opposite = edge.nodes[1 - end];
                  const double sign = (end == 1 ? 0.5 : -0.5);
                  tangent           = {0.5 * (along + on), {{far, sign}, {opposite, -sign}}};
                }
              if (n > 1)
                tangent = {along, {{edge.nodes[1], 1.}, {edge.nodes[0], -1.}}};
            }
        }
      return result;
    }
  } // namespace



  void
  EdgeSearch::find_edges(std::vector<FoundBetweenNodes> &found) const
  {
    const std::vector<EdgeOfLine> own = lines_of_edges(slave_exchange.faces());
    if (own.empty())
      return;
    const std::vector<EdgeOfLine>            others = lines_of_edges(exchange.faces());
    std::vector<std::pair<Box, std::size_t>> boxes;
    for (std::size_t i = 0; i < others.size(); ++i)
      boxes.emplace_back(Box(std::vector<Point<dim>>{others[i].edge.a, others[i].edge.b}), i);
    const auto tree = pack_rtree(boxes);
    for (const EdgeOfLine &line : own)
      {
        const SharpEdge &edge = line.edge;
        if (!owned({edge.nodes[0], edge.nodes[1]}))
          continue;
        Box box(std::vector<Point<dim>>{edge.a, edge.b});
        // Edges may have passed each other by a part of their length within the step.
        box.extend(edge.a.distance(edge.b));
        namespace query = boost::geometry::index;
        for (const auto &entry : tree | query::adaptors::queried(query::intersects(box)))
          add_crossing(line, others[entry.second], found);
      }
  }



  void
  EdgeSearch::add_crossing(const EdgeOfLine               &line,
                           const EdgeOfLine               &other_line,
                           std::vector<FoundBetweenNodes> &found) const
  {
    const SharpEdge &edge = line.edge, &other = other_line.edge;
    const bool       held = is_held(edge.nodes[0], other.key) || is_held(edge.nodes[1], other.key);
    // Edges in contact may be pressed flat.
    const auto crossing = edge_crossing(edge,
                                        other,
                                        Tolerances::beyond_bend,
                                        held ? 1. : Tolerances::along_normal_cosine);
    if (!crossing)
      return;
    const Point<dim>   x[2] = {start.at(edge.nodes[0]), start.at(edge.nodes[1])};
    const Point<dim>   y[2] = {start.at(other.nodes[0]), start.at(other.nodes[1])};
    const double       a = crossing->along_first, b = crossing->along_second;
    const double       a_before = foot(x, y, a);
    const unsigned int end      = node_of_row({edge.nodes[0], edge.nodes[1]},
                                         other.key,
                                         {1. - a, a},
                                         {1. - a_before, a_before});
    if (end == numbers::invalid_unsigned_int)
      return;
    FoundBetweenNodes result;
    result.contact      = std::make_shared<EdgeContact>(line, other_line, *crossing, end);
    result.nodes        = {{edge.nodes[end], end == 0 ? 1. - a : a},
                           {edge.nodes[1 - end], end == 0 ? a : 1. - a}};
    result.held         = held;
    const double length = edge.a.distance(edge.b), length_other = other.a.distance(other.b);
    result.beyond =
      2. * (std::max({0., -a, a - 1.}) * length + std::max({0., -b, b - 1.}) * length_other);
    const double gap_before =
      ((x[0] + a * (x[1] - x[0])) - (y[0] + b * (y[1] - y[0]))) * crossing->normal;
    const double deep = -Tolerances::deep_edge * std::min(length, length_other);
    result.before     = result.contact->gap() < deep && gap_before < deep;
    result.order      = {{other.key, edge.key}};
    found.push_back(result);
  }



  bool
  EdgeSearch::touches_in(const Index vertex, const Tensor<1, dim> &normal, const bool before) const
  {
    for (const auto &[face, m] : around.at(vertex))
      {
        // The two neighbours along the edges of the face; nodes of faces of degree 1 are corners.
        Tensor<1, dim> edges[2];
        for (unsigned int i = 0; i < 2; ++i)
          {
            const unsigned int neighbour = m ^ (i + 1);
            edges[i]                     = face->reference[neighbour] - face->reference[m] +
                       (before ? face->committed[neighbour] - face->committed[m]
                               : face->displacement[neighbour] - face->displacement[m]);
            if (edges[i] * normal < -Tolerances::out_of_plane * edges[i].norm())
              return false;
          }
        const double         sign    = (m == 0 || m == 3) ? 1. : -1.;
        const Tensor<1, dim> outward = sign * cross_product_3d(edges[0], edges[1]);
        if (-1. * (outward * normal) > Tolerances::along_normal_cosine * outward.norm())
          return false;
      }
    return true;
  }



  void
  EdgeSearch::find_vertices(std::vector<FoundBetweenNodes> &found) const
  {
    const std::vector<Face>                 &faces = slave_exchange.faces();
    std::vector<std::pair<Box, std::size_t>> boxes;
    for (std::size_t i = 0; i < faces.size(); ++i)
      {
        Box box = box_of(faces[i]);
        box.extend(faces[i].position(0).distance(faces[i].position(faces[i].n_nodes() - 1)));
        boxes.emplace_back(box, i);
      }
    const auto               tree = pack_rtree(boxes);
    std::vector<std::size_t> near;
    for (const auto &[vertex, corners] : around)
      {
        const auto &[face, m] = corners.front();
        if (!on_sharp_edge(corners))
          continue;
        near.clear();
        namespace query = boost::geometry::index;
        for (const auto &entry :
             tree | query::adaptors::queried(query::intersects(face->position(m))))
          near.push_back(entry.second);
        add_vertex(vertex, near, found);
      }
  }



  void
  EdgeSearch::add_vertex(const Index                     vertex,
                         const std::vector<std::size_t> &near,
                         std::vector<FoundBetweenNodes> &found) const
  {
    const auto &[other, number] = around.at(vertex).front();
    const Point<dim> x          = other->position(number);
    const Face      *closest    = nullptr;
    Projection       best;
    for (const std::size_t i : near)
      {
        const Face        &face     = slave_exchange.faces()[i];
        const FaceGeometry geometry = slave_exchange.geometry(face);
        if (other->edge_normals[number] * geometry.normal({{0., 0.}}) >= 0.)
          continue;
        const Projection now = closest_point_projection(x, geometry);
        // Of faces that are equally close, as on their common edge, the one with the smaller key.
        const double edge = Tolerances::on_edge * face.position(0).distance(face.position(3));
        const double tie  = Tolerances::equal_squares * now.distance_squared + edge * edge;
        if (closest == nullptr || now.distance_squared < best.distance_squared - tie ||
            (now.distance_squared < best.distance_squared + tie && face.key < closest->key))
          {
            closest = &face;
            best    = now;
          }
      }
    if (closest == nullptr || best.beyond_outer > Tolerances::in_wedge ||
        best.beyond_inner > Tolerances::beyond_bend ||
        !owned({closest->nodes.begin(), closest->nodes.begin() + closest->n_nodes()}))
      return;
    const FoundBetweenNodes result = vertex_in_face(vertex, *closest, best.xi);
    if (result.contact)
      found.push_back(result);
  }



  FoundBetweenNodes
  EdgeSearch::vertex_in_face(const Index                  vertex,
                             const Face                  &face,
                             const std::array<double, 2> &xi) const
  {
    const auto &[other, number] = around.at(vertex).front();
    Face at_start               = face;
    at_start.displacement       = face.committed;
    const FaceGeometry geometry(face, slave.exact_surface(face), MasterNormal::averaged),
      of_start(at_start, slave.exact_surface(face), MasterNormal::face);
    const Point<dim> x_start = start.at(vertex);
    const FaceShapes shapes(face.degree, xi),
      before(face.degree, closest_point_projection(x_start, of_start).xi);
    std::vector<Index>  nodes;
    std::vector<double> weights, weights_before;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      {
        nodes.push_back(face.nodes[m]);
        weights.push_back(shapes.value[m]);
        weights_before.push_back(before.value[m]);
      }
    std::uint64_t key = other->key;
    for (const auto &entry : around.at(vertex))
      key = std::min(key, entry.first->key);
    FoundBetweenNodes result;
    result.held =
      std::any_of(nodes.begin(), nodes.end(), [&](const Index node) { return is_held(node, key); });
    // What is in contact may be pressed flat, at first or within the step.
    if (!result.held && !touches_in(vertex, geometry.normal(xi), /*before=*/false) &&
        !touches_in(vertex, of_start.normal(xi), /*before=*/true))
      return result;
    const unsigned int local = node_of_row(nodes, key, weights, weights_before);
    if (local == numbers::invalid_unsigned_int)
      return result;

    result.contact =
      std::make_shared<VertexContact>(vertex, key, other->position(number), geometry, xi, local);
    result.nodes = {{nodes[local], weights[local]}};
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      if (m != local)
        result.nodes.emplace_back(nodes[m], weights[m]);
    result.of_vertex   = true;
    const double deep  = -Tolerances::deep_edge * face.position(0).distance(face.position(3));
    const double began = (x_start - of_start.evaluate(xi).x) * geometry.normal(xi);
    result.before      = result.contact->gap() < deep && began < deep;
    result.order       = {{key, face.key}};
    return result;
  }
} // namespace Touchstone
