// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/surface.h>

#include <algorithm>
#include <cmath>
#include <map>

// The vectors of a slave surface along which slip is measured: they move with the material, so that
// friction follows a body that turns (doc/theory.md 8).
namespace Touchstone
{
  using namespace dealii;

  std::array<Stencil, 2>
  Surface::material_tangents(const PointOnFaces &list) const
  {
    // Tangents of the faces at the point in the reference state.
    std::vector<std::array<Tensor<1, dim>, 2>> tangents;
    Tensor<1, dim>                             normal;
    for (const auto &[face, xi] : list)
      {
        // The frame of the point: its mean normal in the reference state and two directions
        // perpendicular to it.
        const FaceShapes              shapes(face->degree, xi);
        std::array<Tensor<1, dim>, 2> t;
        for (unsigned int m = 0; m < face->n_nodes(); ++m)
          for (unsigned int b = 0; b < 2; ++b)
            t[b] += shapes.gradient[m][b] * face->reference[m];
        tangents.push_back(t);
        normal += cross_product_3d(t[0], t[1]);
      }
    normal /= normal.norm();
    // Any direction across the normal will do; the longest avoids round-off at sharp edges.
    std::array<Tensor<1, dim>, 2> directions;
    for (const auto &t : tangents)
      for (const Tensor<1, dim> &tangent : t)
        {
          const Tensor<1, dim> across = (tangent - (tangent * normal) * normal) / tangent.norm();
          if (across.norm() > 1.1 * directions[0].norm())
            directions[0] = across;
        }
    directions[0] /= directions[0].norm();
    directions[1] = -cross_product_3d(normal, directions[0]);

    // Each direction d is the image of a combination c_0, c_1 of the face tangents; sum_m (c .
    // grad N_m) x_m is then a vector of the surface that moves with the material. Solved by the
    // metric g_ab = t_a . t_b.
    std::array<std::map<Index, double>, 2> sum;
    for (std::size_t f = 0; f < list.size(); ++f)
      {
        const auto &[face, xi] = list[f];
        const auto      &t     = tangents[f];
        const FaceShapes shapes(face->degree, xi);
        const double     g00 = t[0] * t[0], g01 = t[0] * t[1], g11 = t[1] * t[1];
        const double     area = std::sqrt(g00 * g11 - g01 * g01);
        for (unsigned int a = 0; a < 2; ++a)
          {
            // The part of the direction in the face, by its tangents; times the area, which
            // makes faces count as they do in averaged normals.
            const double r0 = t[0] * directions[a], r1 = t[1] * directions[a];
            const double c0 = (g11 * r0 - g01 * r1) / area, c1 = (g00 * r1 - g01 * r0) / area;
            std::array<double, Face::max_nodes> weights{};
            for (unsigned int m = 0; m < face->n_nodes(); ++m)
              weights[m] = c0 * shapes.gradient[m][0] + c1 * shapes.gradient[m][1];
            // Constraints on the slip must not refer to hanging nodes, which follow the slave
            // node: a constraint would then depend on itself.
            const TraceBasis *basis = trace(*face);
            if (basis)
              weights = basis->apply(weights);
            for (unsigned int m = 0; m < face->n_nodes(); ++m)
              if (weights[m] != 0.)
                sum[a][basis ? basis->nodes[m] : face->nodes[m]] += weights[m];
          }
      }

    std::array<Stencil, 2> result;
    for (unsigned int a = 0; a < 2; ++a)
      for (const auto &[index, weight] : sum[a])
        result[a].push_back({index, weight});
    return result;
  }



  std::vector<std::array<Stencil, 2>>
  Surface::material_tangents() const
  {
    // Summed in the order of keys, so that results do not depend on the partition.
    std::unordered_map<Index, CornersOfFaces> around;
    for (const auto *list : {&faces, &ghost_faces})
      for (const Face &face : *list)
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          around[face.nodes[m]].emplace_back(&face, m);
    for (auto &entry : around)
      std::sort(entry.second.begin(), entry.second.end(), [](const auto &a, const auto &b) {
        return a.first->key < b.first->key;
      });

    std::vector<std::array<Stencil, 2>> result;
    for (const SurfaceNode &node : nodes)
      {
        PointOnFaces at_node;
        for (const auto &[face, corner] : around.at(node.node))
          at_node.emplace_back(face, node_coordinates(*face, corner));
        result.push_back(material_tangents(at_node));
      }
    return result;
  }
} // namespace Touchstone
