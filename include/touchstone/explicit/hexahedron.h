// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_hexahedron_h
#define touchstone_explicit_hexahedron_h

#include <touchstone/explicit/node_map.h>

#include <deal.II/base/tensor.h>

#include <array>

namespace Touchstone
{
  /**
   * @brief Shape functions of a hexahedron of eight nodes with 2x2x2 points, from the positions of
   * its nodes alone.
   *
   * FEValues may reuse what it knows of a cell of the same shape that it has seen before, so that
   * the last digits depend on the order of the cells; here they do not (doc/explicit.md, section
   * 2).
   */
  class Hexahedron
  {
  public:
    static constexpr unsigned int n_nodes = 8, n_points = 8;
    using Corners = std::array<dealii::Tensor<1, dim>, n_nodes>;

    /** @brief Value of shape @p a at point @p q. */
    static double
    shape(unsigned int q, unsigned int a);

    /** @brief Set the positions of the nodes, length. @return the smallest determinant of the
     * Jacobian at the points: unless it is positive, weights and gradients mean nothing. */
    double
    reinit(const Corners &positions);

    /** @brief Volume that a point stands for. */
    double
    weight(const unsigned int q) const
    {
      return weights[q];
    }

    double
    volume() const
    {
      return total;
    }

    /** @brief Gradient of shape @p a at point @p q. */
    const dealii::Tensor<1, dim> &
    gradient(const unsigned int q, const unsigned int a) const
    {
      return gradients[q][a];
    }

    /** @brief Derivatives of the coordinates of the unit cell by position at point @p q. */
    const dealii::Tensor<2, dim> &
    inverse_jacobian(const unsigned int q) const
    {
      return inverses[q];
    }

    /** @brief Gradient of incompatible mode @p k at point @p q, see ElementKernel. */
    dealii::Tensor<1, dim>
    mode_gradient(unsigned int q, unsigned int k) const;

    /** @brief Mean of the gradients of shape @p a over the volume. The product with the volume is
     * the exact derivative of the volume by the position of the node. */
    dealii::Tensor<1, dim>
    mean_gradient(unsigned int a) const;

    /** @brief int N_a dV. */
    double
    nodal_volume(unsigned int a) const;

  private:
    std::array<double, n_points>                                      weights;
    std::array<double, n_points>                                      determinants;
    std::array<dealii::Tensor<2, dim>, n_points>                      inverses;
    std::array<std::array<dealii::Tensor<1, dim>, n_nodes>, n_points> gradients;
    dealii::Tensor<2, dim>                                            centre_inverse;
    double                                                            centre_determinant = 0.;
    double                                                            total              = 0.;
  };

  /** @brief Positions of these nodes of a cell, moved by @p u unless that is null. */
  Hexahedron::Corners
  corners(const NodeMap &map, const NodeMap::CellNodes &nodes, const NodeField *u = nullptr);
} // namespace Touchstone

#endif
