// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/slave_direction.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>

// Directions of slave nodes (doc/theory.md 3.4): n = s/|s| with the sum s of the area vectors of
// faces at the node.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Cosine between directions that are the same. */
    constexpr double same_direction = 1. - 1e-10;
  } // namespace



  std::vector<SlaveDirection>
  slave_directions(const Surface &surface, const Index node)
  {
    const auto                  around = surface.faces_around(node);
    std::vector<SlaveDirection> result{{surface.normal(node), around}};
    for (const auto &[face, m] : around)
      {
        const Tensor<1, dim> &n = face->normals[m];
        if (std::any_of(result.begin(), result.end(), [&n](const SlaveDirection &other) {
              return other.n * n > same_direction;
            }))
          continue;
        // The faces that Surface::move() has averaged with this one.
        SlaveDirection side{n, {}};
        for (const auto &[other, k] : around)
          if (other->own_normals[k] * face->own_normals[m] > Tolerances::sharp_edge_cosine)
            side.faces.emplace_back(other, k);
        result.push_back(side);
      }
    return result;
  }



  std::vector<std::pair<Index, Tensor<2, dim>>>
  differentiate(const Surface &surface, const SlaveDirection &direction)
  {
    std::vector<std::pair<Index, Tensor<2, dim>>> result;
    Tensor<1, dim>                                sum;
    for (const auto &[face, m] : direction.faces)
      {
        const std::array<double, 2> xi = node_coordinates(*face, m);
        const auto                  t  = evaluate(*face, surface.exact_surface(*face), xi).tangents;
        sum += cross_product_3d(t[0], t[1]);
        // d (t_1 x t_2): the tangents are linear in the displacements.
        const Tensor<2, dim> by_first = -1. * cross_matrix(t[1]), by_second = cross_matrix(t[0]);
        const FaceShapes     shapes(face->degree, xi);
        for (unsigned int l = 0; l < face->n_nodes(); ++l)
          {
            const auto &gradient = shapes.gradient[l];
            if (gradient[0] == 0. && gradient[1] == 0.)
              continue;
            const Index node  = face->nodes[l];
            auto        entry = std::find_if(result.begin(), result.end(), [node](const auto &e) {
              return e.first == node;
            });
            if (entry == result.end())
              entry = result.insert(entry, {node, Tensor<2, dim>()});
            entry->second += gradient[0] * by_first + gradient[1] * by_second;
          }
      }
    const Tensor<2, dim> normalised = normalisation_derivative(sum);
    for (auto &entry : result)
      entry.second = normalised * entry.second;
    return result;
  }
} // namespace Touchstone
