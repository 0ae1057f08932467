// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/surface_cone.h>

#include <algorithm>
#include <cmath>

// All directions in which a contact force may act on a surface at a node: non-negative combinations
// of the normals of the faces around it. UnresolvedContact measures how far a force lies outside
// (doc/theory.md 4.1).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    bool
    has(const Face &face, const Index node)
    {
      const auto end = face.nodes.begin() + face.n_nodes();
      return std::find(face.nodes.begin(), end, node) != end;
    }

  } // namespace



  SurfaceCone::SurfaceCone(const Surface &surface, const Index node)
  {
    const auto faces = surface.faces_around(node);
    for (const auto &[face, m] : faces)
      // Normals at the other nodes of these faces belong to the cone: on curved facets the force of
      // a node acts over all of its faces.
      for (unsigned int l = 0; l < face->n_nodes(); ++l)
        {
          around.push_back(face->nodes[l]);
          normals.push_back(face->own_normals[l]);
        }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());

    for (const auto &[face, m] : faces)
      {
        // Where an edge at the node belongs to one face only, the surface ends and the body goes on
        // behind it with a side that is not part of the pair: directions up to the outward one in
        // the tangent plane of the face, across that edge, are admitted.
        const unsigned int p = face->degree, last = face->n_nodes() - 1;
        const unsigned int edges[4][2] = {{0, last - p}, {p, last}, {0, p}, {last - p, last}};
        const auto         xi          = node_coordinates(*face, m);
        const bool         on[4]       = {xi[0] == -1., xi[0] == 1., xi[1] == -1., xi[1] == 1.};
        for (unsigned int e = 0; e < 4; ++e)
          {
            const unsigned int i = edges[e][0], j = edges[e][1];
            const bool         shared =
              std::count_if(faces.begin(),
                            faces.end(),
                            [&, nodes = face->nodes](const auto &other) {
                              return has(*other.first, nodes[i]) && has(*other.first, nodes[j]);
                            }) > 1;
            if (!on[e] || shared)
              continue;
            Tensor<1, dim> away =
              cross_product_3d(face->position(j) - face->position(i), face->own_normals[m]);
            away /= away.norm();
            // Oriented away from the opposite edge of the face.
            const double side = away * (face->position(i) - face->position(last - j));
            normals.push_back(side > 0. ? away : -1. * away);
          }
      }
  }



  void
  SurfaceCone::mirror(const std::vector<Tensor<1, dim>> &planes)
  {
    for (const Tensor<1, dim> &plane : planes)
      for (std::size_t k = 0, n = normals.size(); k < n; ++k)
        normals.push_back(normals[k] - 2. * (normals[k] * plane) * plane);
  }



  double
  SurfaceCone::distance(const Tensor<1, dim> &direction) const
  {
    // Closest point of the cone sum c_k n_k, c_k >= 0, by relaxation of one c_k after the
    // other: what is left of the direction is the distance.
    constexpr unsigned int sweeps = 100;
    std::vector<double>    c(normals.size(), 0.);
    Tensor<1, dim>         left = direction;
    for (unsigned int sweep = 0; sweep < sweeps; ++sweep)
      {
        double change = 0.;
        for (std::size_t k = 0; k < normals.size(); ++k)
          {
            // Minimise |direction - sum c_k n_k|^2 by c_k alone, as the n_k are unit vectors;
            // "left" is the residual vector.
            const double next = std::max(0., c[k] + left * normals[k]);
            left -= (next - c[k]) * normals[k];
            change = std::max(change, std::abs(next - c[k]));
            c[k]   = next;
          }
        if (change < 1e-4)
          break;
      }
    return left.norm();
  }
} // namespace Touchstone
