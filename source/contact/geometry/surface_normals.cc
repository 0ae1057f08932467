// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/facet_rotation.h>
#include <touchstone/contact/geometry/surface.h>

#include <algorithm>
#include <cmath>

// Present positions of the faces, their averaged normals and the derivative of these (doc/theory.md
// 5).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Between normals of planes that are one. */
    constexpr double same_plane_cosine = 1. - 1e-6;

    /** t_1 x t_2: faces count by their area around a node. */
    Tensor<1, dim>
    area_vector(const std::array<Tensor<1, dim>, 2> &tangents)
    {
      return cross_product_3d(tangents[0], tangents[1]);
    }
  } // namespace



  void
  Surface::set_planes_of_symmetry(const std::map<Index, std::vector<Tensor<1, dim>>> &planes)
  {
    for (NodeOfFaces &node : surface_nodes)
      {
        const auto found = planes.find(node.node);
        node.images      = found != planes.end() ? MirrorImages(found->second) : MirrorImages();
      }
    const auto on_one = [&planes](const Edge &edge) {
      const auto first = planes.find(edge.first), second = planes.find(edge.second);
      if (first == planes.end() || second == planes.end())
        return false;
      return std::any_of(first->second.begin(), first->second.end(), [&](const auto &plane) {
        return std::any_of(second->second.begin(), second->second.end(), [&](const auto &other) {
          return std::abs(plane * other) > same_plane_cosine;
        });
      });
    };
    for (Face &face : faces)
      {
        const auto all      = edges(face);
        face.mirrored_edges = 0;
        for (unsigned int e = 0; e < 4; ++e)
          if (face.outer_edges & (1u << e) && on_one(all[e]))
            face.mirrored_edges |= 1u << e;
      }
    set_made_normals();
  }



  void
  Surface::set_without_rows(const std::set<Index> &without)
  {
    for (std::vector<Face> *list : {&faces, &ghost_faces})
      for (Face &face : *list)
        {
          const TraceBasis *const basis = trace(face);
          const auto             &nodes = basis ? basis->nodes : face.nodes;
          unsigned int            found = 0;
          for (unsigned int m = 0; m < face.n_nodes(); ++m)
            found += face.without_row[m] = without.count(nodes[m]) > 0;
          if (found == face.n_nodes())
            face.without_row = {};
        }
  }



  void
  Surface::move(const Vector &u)
  {
    for (const NodeOfFaces &node : surface_nodes)
      {
        Tensor<1, dim> displacement;
        for (unsigned int d = 0; d < dim; ++d)
          displacement[d] = u(dim * node.node + d);
        for (const auto &[face, m] : node.faces)
          face->displacement[m] = displacement;
      }
    set_normals();
  }



  void
  Surface::set_made_normals()
  {
    std::vector<decltype(Face::displacement)> present;
    for (auto *list : {&faces, &ghost_faces})
      for (Face &face : *list)
        {
          present.push_back(face.displacement);
          face.displacement = {};
        }
    set_normals();
    auto displacement = present.begin();
    for (auto *list : {&faces, &ghost_faces})
      for (Face &face : *list)
        {
          face.made_normals = face.normals;
          face.displacement = *displacement++;
        }
    set_normals();
  }



  void
  Surface::set_normals()
  {
    // Normals of the faces at their nodes, in length weighted by the area that
    // the face has around the node.
    std::vector<FaceShapes> at_nodes;
    auto                    tangents = reference_tangents.begin();
    for (auto *list : {&faces, &ghost_faces})
      for (Face &face : *list)
        {
          // Equation (8), without projections: those of the reference state are known.
          const bool           turns    = exact_surface(face) != nullptr;
          const Tensor<2, dim> rotation = turns ? facet_rotation(face) : Tensor<2, dim>();
          const auto moved = turns ? relative_displacement(face, rotation) : face.displacement;
          for (unsigned int m = 0; m < face.n_nodes(); ++m, ++tangents)
            {
              // All faces are of one degree.
              if (at_nodes.size() == m)
                at_nodes.emplace_back(face.degree, node_coordinates(face, m));
              auto t = *tangents;
              for (unsigned int a = 0; a < 2; ++a)
                {
                  if (turns)
                    t[a] = rotation * t[a];
                  for (unsigned int l = 0; l < face.n_nodes(); ++l)
                    t[a] += at_nodes[m].gradient[l][a] * moved[l];
                }
              face.normals[m]     = area_vector(t);
              const double length = face.normals[m].norm();
              face.own_normals[m] = length > 0. ? face.normals[m] / length : face.normals[m];
            }
        }
    for (NodeOfFaces &node : surface_nodes)
      average_normals(node);
  }



  NormalsAtNode
  Surface::normals_at(const NodeOfFaces &node, const std::size_t i)
  {
    const auto &[face, m] = node.faces[i];
    return {face->own_normals[m], facet_rotation(*face) * node.as_made[i]};
  }



  void
  Surface::average_normals(NodeOfFaces &node)
  {
    // Average the area vectors around the node with their images beyond planes of symmetry, once
    // over all faces (edge_normals, the pseudonormal of an edge) and once for each face over those
    // that it does not meet in a sharp edge (normals).
    const auto unit = [](const std::pair<Face *, unsigned int> &at) {
      return at.first->own_normals[at.second];
    };
    parts.clear();
    Tensor<1, dim> all;
    bool           smooth = true;
    for (std::size_t k = 0; k < node.faces.size(); ++k)
      {
        const auto &[face, m] = node.faces[k];
        parts.push_back(face->normals[m]);
        all += parts.back();
        for (std::size_t i = 0; i <= k && smooth; ++i)
          smooth = node.images.smooth(unit(node.faces[i]), unit(node.faces[k]));
      }
    if (!node.images.empty())
      all = node.images.all(all) * all;
    if (const double length = all.norm(); length > 0.)
      all /= length;
    node.normal = all;
    at_node.clear();
    // Around a smooth node both averages are the same for all faces.
    for (std::size_t i = 0; i < parts.size() && !smooth; ++i)
      at_node.push_back(normals_at(node, i));
    for (std::size_t k = 0; k < parts.size(); ++k)
      {
        const auto &[face, m] = node.faces[k];
        face->edge_normals[m] = face->normals[m] = all;
        Tensor<1, dim> sum;
        for (std::size_t i = 0; i < at_node.size(); ++i)
          sum += node.images.averaged_with(at_node[i], at_node[k]) * parts[i];
        if (const double length = sum.norm(); length > 0.)
          face->normals[m] = sum / length;
      }
  }



  std::vector<NormalShare>
  Surface::normal_shares(const Index index) const
  {
    const NodeOfFaces       &node = node_of_faces(index);
    std::vector<NormalShare> result;
    Tensor<1, dim>           sum;
    for (const auto &[face, m] : node.faces)
      sum += area_vector(tangents(*face, m));
    const Tensor<2, dim> weight = node.images.all(sum);
    for (const auto &[face, m] : node.faces)
      result.push_back({face, m, weight});
    return result;
  }



  std::vector<NormalShare>
  Surface::normal_shares(const Face &face, const unsigned int m) const
  {
    const NodeOfFaces       &node = node_of_faces(face.nodes[m]);
    std::vector<NormalShare> result;
    const auto own = std::find_if(node.faces.begin(), node.faces.end(), [&](const auto &at) {
      return at.first->key == face.key && at.second == m;
    });
    AssertThrow(own != node.faces.end(), ExcInternalError());
    const NormalsAtNode normals = normals_at(node, own - node.faces.begin());
    for (std::size_t i = 0; i < node.faces.size(); ++i)
      if (const Tensor<2, dim> weight = node.images.averaged_with(normals_at(node, i), normals);
          weight.norm() > 0.)
        result.push_back({node.faces[i].first, node.faces[i].second, weight});
    return result;
  }



  std::array<Tensor<1, dim>, 2>
  Surface::tangents(const Face &face, const unsigned int m) const
  {
    return evaluate(face, exact_surface(face), node_coordinates(face, m)).tangents;
  }



  std::vector<std::pair<Index, Tensor<2, dim>>>
  Surface::normal_derivative(const std::vector<NormalShare> &shares) const
  {
    std::vector<std::pair<Index, Tensor<2, dim>>> result;
    Tensor<1, dim>                                sum;
    // n = s/|s| with the sum s of the area vectors of faces and their images, each a function of
    // all nodes of its face.
    for (const auto &[face, m, weight] : shares)
      {
        const auto t = tangents(*face, m);
        sum += weight * area_vector(t);
        // d (t_0 x t_1), where the tangents are linear in the displacements.
        const Tensor<2, dim> by_first  = -1. * (weight * cross_matrix(t[1])),
                             by_second = weight * cross_matrix(t[0]);
        const FaceShapes   shapes(face->degree, node_coordinates(*face, m));
        const bool         turns = exact_surface(*face) != nullptr;
        const NodeMatrices turn  = turns ? facet_rotation_derivative(*face) : NodeMatrices();
        const auto by_nodes      = tangent_derivatives(*face, shapes, t, turns ? &turn : nullptr);
        for (unsigned int l = 0; l < face->n_nodes(); ++l)
          {
            // A node that is not on a line of the mesh through this one does not turn its facet.
            if (by_nodes[0][l].norm_square() + by_nodes[1][l].norm_square() == 0.)
              continue;
            const Index node  = face->nodes[l];
            auto        entry = std::find_if(result.begin(), result.end(), [node](const auto &e) {
              return e.first == node;
            });
            if (entry == result.end())
              entry = result.insert(entry, {node, Tensor<2, dim>()});
            // A node of several of these faces gets one entry.
            entry->second += by_first * by_nodes[0][l] + by_second * by_nodes[1][l];
          }
      }
    const Tensor<2, dim> normalised = normalisation_derivative(sum);
    for (auto &entry : result)
      entry.second = normalised * entry.second;
    return result;
  }



  std::vector<NormalDerivative>
  Surface::normal_derivative(const Face &face) const
  {
    std::vector<NormalDerivative> result;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      for (const auto &[node, value] : normal_derivative(normal_shares(face, m)))
        result.push_back({m, node, value});
    return result;
  }
} // namespace Touchstone
