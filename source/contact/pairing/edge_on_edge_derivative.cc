// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/face_derivative.h>
#include <touchstone/contact/pairing/edge_on_edge.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>

// Derivatives of the rows of nodes on edges (doc/theory.md 4.2, "Parallel edges").
namespace Touchstone
{
  using namespace dealii;

  void
  EdgeOnEdge::add_faces(std::vector<const Face *> &faces) const
  {
    for (const Side &side : sides)
      if (side.sign > 0.)
        faces.push_back(side.face);
  }



  // d = x - y_0 - a e with d.e = 0 gives da; over an end y, d = x_o + W e - y with d.e = 0 gives
  // dW.
  std::vector<EdgeOnEdge::Motion>
  EdgeOnEdge::motions() const
  {
    const Tensor<2, dim> identity(unit_symmetric_tensor<dim>());
    // Of each node with unit motion the motion of d at a fixed foot, and of e.
    const auto move = [&](const Index node, const double at_foot, const double of_edge) {
      Motion                result{node, at_foot * identity, {}};
      const Tensor<1, dim> &e = over_end ? slave_edge : edge;
      if (!free)
        return result;
      result.fraction =
        ((over_end ? -at_foot : at_foot) * e - (over_end ? of_edge : -of_edge) * distance) /
        e.norm_square();
      result.distance += (over_end ? 1. : -1.) * outer_product(e, result.fraction);
      return result;
    };
    if (!over_end)
      return {move(slave, 1., 0.), move(nodes[0], along - 1., -1.), move(nodes[1], -along, 1.)};
    return {move(slave, weight, 1.),
            move(other, 1. - weight, -1.),
            move(nodes[0], along - 1., 0.),
            move(nodes[1], -along, 0.)};
  }



  // The normal is the direction of the sum of two unit vectors.
  void
  EdgeOnEdge::differentiate(const Surface   &slave_surface,
                            const OfNormals &of_normals,
                            ContactRow      &row) const
  {
    // Where the node stands on an end of the edge, the weight of the other end is zero but changes.
    const std::vector<Motion> moved = motions();
    for (const Motion &motion : moved)
      if (motion.node != slave &&
          std::none_of(row.stencil.begin(), row.stencil.end(), [&](const StencilEntry &entry) {
            return entry.node == motion.node;
          }))
        row.stencil.push_back({motion.node, 0.});
    RowDerivativeBuilder builder(row.stencil.size());
    RowDerivative       &result = *builder.result;
    const Tensor<2, dim> turn   = normalisation_derivative(sides[0].normal + sides[1].normal);
    std::array<Tensor<2, dim>, 2> by_side;
    Tensor<1, dim>                by_fraction;
    for (unsigned int k = 0; k < 2; ++k)
      {
        const Side &side = sides[k];
        by_side[k]       = side.sign * (turn * normalisation_derivative(side.sum_of_normals()));
        // The weight W of the slave is that of the first corner, the fraction of the master that of
        // the second one.
        if ((side.sign < 0.) == over_end)
          by_fraction +=
            (over_end ? -1. : 1.) * (by_side[k] * (side.face->normals[side.corners[1]] -
                                                   side.face->normals[side.corners[0]]));
      }
    for (const Motion &motion : moved)
      {
        const std::size_t i = builder.index(motion.node);
        result.normal[i] += outer_product(by_fraction, motion.fraction);
        result.gap_vector[i] += motion.distance / weight;
        if (over_end)
          result.gap_vector[i] -= outer_product(distance, motion.fraction) / (weight * weight);
        for (std::size_t m = 0; m < row.stencil.size(); ++m)
          {
            const Index node = row.stencil[m].node;
            // 1 - a and a, or 1 - 1/W for the other node and 1/W for the end.
            const double change =
              over_end ? (node == other ? 1. : -(node == nodes[0] ? 1. - along : along)) /
                           (weight * weight)
                       : (node == nodes[0] ? -1. : 1.);
            result.weights[m][i] += change * motion.fraction;
          }
      }
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int end = 0; end < 2; ++end)
        {
          const Side          &side   = sides[k];
          const Tensor<2, dim> by_end = side.weights[end] * by_side[k];
          if (side.sign < 0.)
            {
              for (const auto &[node, value] : slave_surface.normal_derivative(
                     slave_surface.normal_shares(*side.face, side.corners[end])))
                result.normal[builder.index(node)] += by_end * value;
            }
          else if (const auto found = of_normals.find(side.face); found != of_normals.end())
            for (const NormalDerivative &d : found->second)
              if (d.m == side.corners[end])
                result.normal[builder.index(d.node)] += by_end * d.value;
        }
    row.derivative = builder.result;
  }
} // namespace Touchstone
