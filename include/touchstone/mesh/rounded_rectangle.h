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

  private:
    /** Numbers and sizes of the cells before they are distorted. Points of the block come first,
     * then those of the rows from the boundary inwards. In a row they count from first(), the end
     * of the second side, over 0, the middle of the rounding, to last(). */
    struct Lattice
    {
      /** Half of the rounding and a row of cells, length. */
      double arc, height;
      /** Cells of half the rounding, and rows. */
      unsigned int half, rows;
      /** Cells of the block. */
      std::array<unsigned int, 2> n;
      /** Positions of the points of each side, from the middle of the rounding, and of those of
       * the opposite side; length. */
      std::array<std::vector<double>, 2> along, block;

      int
      first() const
      {
        return -static_cast<int>(n[1]);
      }
      int
      last() const
      {
        return n[0];
      }
      unsigned int
      n_points() const
      {
        return (n[0] + 1) * (n[1] + 1) + rows * (n[0] + n[1] + 1);
      }
      unsigned int
      in_block(const unsigned int i, const unsigned int j) const
      {
        return i + (n[0] + 1) * j;
      }
      unsigned int
      in_row(const int p, const unsigned int row) const
      {
        // The innermost row ends on the edge of the block.
        if (row == rows)
          return p >= 0 ? in_block(p, 0) : in_block(0, -p);
        return (n[0] + 1) * (n[1] + 1) + row * (n[0] + n[1] + 1) + p + n[1];
      }
    };

    /** @return which points have a place now. */
    std::vector<bool>
    place_outline(const Lattice &lattice, const std::array<double, 2> &lengths, double radius);
    /** @return the sizes of the cells in the lattice, from which smooth() takes its weights. */
    std::vector<std::array<double, 2>>
    add_cells(const Lattice &lattice);
  };
} // namespace Touchstone

#endif
