// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/edge_crossing.h>
#include <touchstone/contact/geometry/face_geometry.h>
#include <touchstone/contact/pairing/edge_search.h>
#include <touchstone/contact/pairing/vertex_contact.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>

// Vertices of the master in slave faces (doc/theory.md 4.2).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    using Box = BoundingBox<dim>;

    Box
    box_of_nodes(const Face &face)
    {
      std::vector<Point<dim>> positions;
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        positions.push_back(face.position(m));
      return Box(positions);
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
          if ((face->ends() & edges) != 0)
            return true;
          normals.push_back(reference_area_vector(*face, m));
          mean += normals.back();
        }
      // The sum with the images beyond planes of symmetry has no component across these.
      for (const auto &[face, m] : corners)
        for (const unsigned int e : {m & 1u, 2u + (m >> 1 & 1u)})
          {
            const Tensor<1, dim> plane = plane_of_symmetry(*face, e);
            mean -= (mean * plane) * plane;
          }
      return std::any_of(normals.begin(), normals.end(), [&](const Tensor<1, dim> &normal) {
        return normal * mean < Tolerances::sharp_node_cosine * normal.norm() * mean.norm();
      });
    }
  } // namespace


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
        Box box = box_of_nodes(faces[i]);
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
    const Face         at_start = at_start_of_step(face);
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
    std::uint64_t key = other->node_key(number);
    for (const auto &[beside, m] : around.at(vertex))
      key = std::min(key, beside->node_key(m));
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
    result.feet        = {{geometry.evaluate(xi).x, other->position(number)}};
    result.order       = {{key, face.key}};
    return result;
  }
} // namespace Touchstone
