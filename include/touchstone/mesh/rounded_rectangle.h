// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_rounded_rectangle_h
#define touchstone_mesh_rounded_rectangle_h

#include <deal.II/base/point.h>
#include <deal.II/grid/tria_description.h>

#include <array>
#include <set>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Quadrilaterals in a rectangle from the origin with sides along x and
   * y, whose corner at the origin is rounded.
   *
   * A rounded corner is none: with three corners left, a mesh of good cells has
   * one inner vertex of three cells, here on the diagonal a few rows from the
   * rounding. The rows follow the first side, the rounding and the second side:
   *
   *     +-----------+-+      s: the vertex of three cells
   *     |           | |      f: middle of the rounding
   *     |           | |
   *     | block     | |      The rows are drawn to the left and below,
   *     |           | |      as they are placed in the rectangle: the
   *     s-----------+ |      block of columns and rows begins at s.
   *      \__________  |
   *       f_________|_+
   *
   * Inner vertices solve a discrete Laplace equation with positive weights.
   * On a convex boundary no cell is folded over then, whatever the weights
   * (Tutte 1963, Proc. London Math. Soc. 13, 743-767); weights that are the
   * inverse of the cells' sizes make rows and columns of the plain rectangle
   * straight.
   */
  struct RoundedRectangle
  {
    /**
     * @param lengths  Sides along x and y, with a sharp corner; length.
     * @param radius   Radius of the rounding, length.
     * @param cells    Cells along the straight part of each of the two sides.
     * @param fillet   Cells along each half of the rounding.
     * @param rows     Rows that follow the two sides and the rounding.
     * @param grading  Last cell of a side over the first one, no unit.
     */
    RoundedRectangle(const std::array<double, 2>       &lengths,
                     double                             radius,
                     const std::array<unsigned int, 2> &cells,
                     unsigned int                       fillet,
                     unsigned int                       rows,
                     double                             grading);

    std::vector<dealii::Point<2>>    points;
    std::vector<dealii::CellData<2>> cells;
    /** Points of the parts of the boundary, each with both ends: the sides along
     * x and y, the rounding between them, and the sides opposite. */
    std::set<unsigned int> first_side, second_side, fillet, far_first_side, far_second_side;
  };
} // namespace Touchstone

#endif
