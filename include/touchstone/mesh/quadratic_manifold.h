// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_quadratic_manifold_h
#define touchstone_mesh_quadratic_manifold_h

#include <deal.II/base/point.h>
#include <deal.II/grid/manifold.h>

#include <array>
#include <memory>
#include <vector>

namespace Touchstone
{
  /** @brief The 27 nodes of a hexahedron of degree 2 in lexicographic order: x first, then y, z. */
  using QuadraticCell = std::array<dealii::Point<3>, 27>;

  /** @brief Point of a cell of degree 2, and the derivatives by the unit coordinates.
   * @param jacobian [i][j] is d x_i / d xi_j, length. */
  dealii::Point<3>
  evaluate(const QuadraticCell &cell, const dealii::Point<3> &unit, dealii::Tensor<2, 3> &jacobian);

  /**
   * @brief The shape of coarse cells of degree 2: new vertices and the nodes of mappings of degree
   * 2 lie where the coarse cell has the mean of the unit coordinates. A mapping of degree 2 thus
   * has the shape of the coarse cells on any refinement of them.
   *
   * @param cells  Of one body, conforming, with positive Jacobian.
   */
  std::unique_ptr<dealii::Manifold<3>>
  make_quadratic_manifold(const std::vector<QuadraticCell> &cells);
} // namespace Touchstone

#endif
