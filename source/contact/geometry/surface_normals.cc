// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/surface.h>
#include <touchstone/contact/tolerances.h>

#include <cmath>

// Present positions of the faces, their averaged normals and the derivative of these (doc/theory.md
// 5).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Whether two faces at a node are averaged: they do not meet in a sharp edge. */
    bool
    averaged_with(const Tensor<1, dim> &unit_normal, const Tensor<1, dim> &own)
    {
      return unit_normal * own > Tolerances::sharp_edge_cosine;
    }
  } // namespace



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
    // Normals of the faces at their nodes, in length weighted by the area that
    // the face has around the node.
    std::vector<FaceShapes> at_nodes;
    auto                    tangents = reference_tangents.begin();
    for (auto *list : {&faces, &ghost_faces})
      for (Face &face : *list)
        for (unsigned int m = 0; m < face.n_nodes(); ++m, ++tangents)
          {
            // All faces are of one degree.
            if (at_nodes.size() == m)
              at_nodes.emplace_back(face.degree, node_coordinates(face, m));
            auto t = *tangents;
            for (unsigned int l = 0; l < face.n_nodes(); ++l)
              for (unsigned int a = 0; a < 2; ++a)
                t[a] += at_nodes[m].gradient[l][a] * face.displacement[l];
            // The area vector t_1 x t_2 of the face at the node: faces count by their area around
            // it.
            face.normals[m]     = cross_product_3d(t[0], t[1]);
            const double length = face.normals[m].norm();
            face.own_normals[m] = length > 0. ? face.normals[m] / length : face.normals[m];
          }
    // Average the area vectors around each node, once over all faces (edge_normals, the
    // pseudonormal of an edge) and once for each face over those that it does not meet in a sharp
    // edge (normals).
    std::vector<Tensor<1, dim>> parts, units;
    for (auto &[node, all, list] : surface_nodes)
      {
        parts.clear();
        units.clear();
        all         = Tensor<1, dim>();
        bool smooth = true;
        for (const auto &[face, m] : list)
          {
            parts.push_back(face->normals[m]);
            all += parts.back();
            for (const Tensor<1, dim> &other : units)
              smooth = smooth && averaged_with(other, face->own_normals[m]);
            units.push_back(face->own_normals[m]);
          }
        if (const double length = all.norm(); length > 0.)
          all /= length;
        for (std::size_t k = 0; k < list.size(); ++k)
          {
            const auto &[face, m] = list[k];
            face->edge_normals[m] = face->normals[m] = all;
            // Around a smooth node both averages are the same for all faces.
            if (smooth)
              continue;
            Tensor<1, dim> sum;
            for (std::size_t i = 0; i < parts.size(); ++i)
              if (averaged_with(units[i], units[k]))
                sum += parts[i];
            if (const double length = sum.norm(); length > 0.)
              face->normals[m] = sum / length;
          }
      }
  }



  std::vector<NormalDerivative>
  Surface::normal_derivative(const Face &face) const
  {
    // Tangents at the nodes of the present state, as in move().
    const auto tangents = [this](const Face &f, const unsigned int m) {
      return evaluate(f, exact_surface(f), node_coordinates(f, m)).tangents;
    };
    std::vector<NormalDerivative> result;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      {
        const std::size_t first = result.size();
        Tensor<1, dim>    sum;
        // n = s/|s| with the sum s of the area vectors of the faces with which this one is
        // averaged, each a function of all nodes of its face.
        for (const auto &[f, k] : node_of_faces(face.nodes[m]).faces)
          {
            const auto           t    = tangents(*f, k);
            const Tensor<1, dim> part = cross_product_3d(t[0], t[1]);
            if (!averaged_with(f->own_normals[k], face.own_normals[m]))
              continue;
            sum += part;
            // d (t_0 x t_1), where the tangents are linear in the displacements.
            const Tensor<2, dim> by_first  = -1. * cross_matrix(t[1]),
                                 by_second = cross_matrix(t[0]);
            const FaceShapes shapes(f->degree, node_coordinates(*f, k));
            for (unsigned int l = 0; l < f->n_nodes(); ++l)
              {
                const auto &gradient = shapes.gradient[l];
                if (gradient[0] == 0. && gradient[1] == 0.)
                  continue;
                auto entry =
                  std::find_if(result.begin() + first,
                               result.end(),
                               [&](const NormalDerivative &d) { return d.node == f->nodes[l]; });
                if (entry == result.end())
                  entry = result.insert(entry, {m, f->nodes[l], Tensor<2, dim>()});
                // A node of several of these faces gets one entry.
                entry->value += gradient[0] * by_first + gradient[1] * by_second;
              }
          }
        const Tensor<2, dim> direction = normalisation_derivative(sum);
        for (auto entry = result.begin() + first; entry != result.end(); ++entry)
          entry->value = direction * entry->value;
      }
    return result;
  }
} // namespace Touchstone
