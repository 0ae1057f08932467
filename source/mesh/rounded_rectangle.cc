// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/body_mesh.h>
#include <touchstone/mesh/rounded_rectangle.h>

#include <deal.II/base/numbers.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <cmath>

// Plane mesh of a rectangle with one rounded corner: rows of cells follow the two sides and the
// rounding between them, behind them is a block of rows and columns. Points of the outline are
// prescribed, those inside follow from a discrete Laplace equation, which spreads the distortion
// beside the rounding over the section.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Positions on one side, as lengths of the path from the middle of the rounding. */
    std::vector<double>
    path(const double       arc,
         const unsigned int fillet,
         const double       straight,
         const unsigned int cells,
         const double       grading)
    {
      std::vector<double> result = graded_positions(0., arc, fillet, 1.);
      result.pop_back();
      for (const double s : graded_positions(arc, arc + straight, cells, grading))
        result.push_back(s);
      return result;
    }



    /** Move the points without a prescribed position to the solution of the
     * Laplace equation whose edge weights are those of rectangles of these @p sizes. */
    void
    smooth(std::vector<Point<2>>                    &points,
           const std::vector<bool>                  &prescribed,
           const std::vector<CellData<2>>           &cells,
           const std::vector<std::array<double, 2>> &sizes)
    {
      struct Edge
      {
        unsigned int a, b;
        double       weight;
      };
      // The weight of an edge is the conductance of a rectangle in its direction, width over
      // length, half of it for each of the two cells at the edge: on a graded rectangular grid
      // the solution is that grid itself.
      std::vector<Edge> edges;
      for (unsigned int c = 0; c < cells.size(); ++c)
        {
          const auto  &v     = cells[c].vertices;
          const double ratio = sizes[c][1] / sizes[c][0];
          for (const unsigned int side : {0, 2})
            edges.push_back({v[side], v[side + 1], ratio / 2.});
          for (const unsigned int side : {0, 1})
            edges.push_back({v[side], v[side + 2], 1. / (2. * ratio)});
        }

      DynamicSparsityPattern dynamic(points.size(), points.size());
      for (unsigned int i = 0; i < points.size(); ++i)
        dynamic.add(i, i);
      for (const Edge &edge : edges)
        {
          dynamic.add(edge.a, edge.b);
          dynamic.add(edge.b, edge.a);
        }
      SparsityPattern pattern;
      pattern.copy_from(dynamic);
      SparseMatrix<double>          matrix(pattern);
      std::array<Vector<double>, 2> x{
        {Vector<double>(points.size()), Vector<double>(points.size())}};
      for (unsigned int i = 0; i < points.size(); ++i)
        // Rows of prescribed points are those of the identity, so the same factors serve x and y.
        if (prescribed[i])
          {
            matrix.set(i, i, 1.);
            for (unsigned int d = 0; d < 2; ++d)
              x[d][i] = points[i][d];
          }
      for (const Edge &edge : edges)
        for (const auto &[row, column] :
             {std::make_pair(edge.a, edge.b), std::make_pair(edge.b, edge.a)})
          if (!prescribed[row])
            {
              matrix.add(row, row, edge.weight);
              matrix.add(row, column, -edge.weight);
            }

      // The prescribed rows make the matrix unsymmetric; the problem is plane and small, and
      // solved directly.
      SparseDirectUMFPACK solver;
      solver.factorize(matrix);
      for (unsigned int d = 0; d < 2; ++d)
        {
          solver.solve(x[d]);
          for (unsigned int i = 0; i < points.size(); ++i)
            if (!prescribed[i])
              points[i][d] = x[d][i];
        }
    }
  } // namespace



  RoundedRectangle::RoundedRectangle(const std::array<double, 2>       &lengths,
                                     const double                       radius,
                                     const std::array<unsigned int, 2> &straight,
                                     const unsigned int                 fillet_half,
                                     const unsigned int                 rows,
                                     const double                       grading)
  {
    // A cell of the rows is as high as one of the rounding is long, so cells at the rounding are
    // about square.
    const double                       arc    = numbers::PI / 4. * radius;
    const double                       height = arc / fillet_half;
    std::array<std::vector<double>, 2> along, block;
    std::array<unsigned int, 2>        n;
    for (unsigned int d = 0; d < 2; ++d)
      {
        n[d]     = straight[d] + fillet_half;
        along[d] = path(arc, fillet_half, lengths[d] - radius, straight[d], grading);
        // On the opposite side the block begins after the rows.
        for (const double s : along[d])
          block[d].push_back(rows * height + (lengths[d] - rows * height) * s / along[d].back());
      }

    // Points of the block, then of the rows from the boundary inwards. In a row they
    // count from -n[1], the end of the second side, over 0, the middle of the
    // rounding, to n[0].
    const unsigned int row_points = n[0] + n[1] + 1;
    const auto         in_block   = [&](const unsigned int i, const unsigned int j) {
      return i + (n[0] + 1) * j;
    };
    const auto in_row = [&](const int p, const unsigned int row) {
      return row == rows ? (p >= 0 ? in_block(p, 0) : in_block(0, -p))
                         : (n[0] + 1) * (n[1] + 1) + row * row_points + p + n[1];
    };
    const int first = -static_cast<int>(n[1]), last = n[0], f = fillet_half;

    points.resize((n[0] + 1) * (n[1] + 1) + rows * row_points);
    std::vector<bool> prescribed(points.size(), false);
    const auto place = [&](const unsigned int v, const Point<2> &x, std::set<unsigned int> &part) {
      points[v]     = x;
      prescribed[v] = true;
      part.insert(v);
    };

    for (int p = first; p <= last; ++p)
      {
        const unsigned int v = in_row(p, 0);
        // Ends of the rounding are placed as points of the sides.
        if (std::abs(p) <= f)
          {
            const double angle = numbers::PI / 4. * (5. + static_cast<double>(p) / f);
            place(v,
                  Point<2>(radius + radius * std::cos(angle), radius + radius * std::sin(angle)),
                  fillet);
          }
        if (p >= f)
          place(v, Point<2>(radius - arc + along[0][p], 0.), first_side);
        if (p <= -f)
          place(v, Point<2>(0., radius - arc + along[1][-p]), second_side);
      }
    // Where the rows end on the far sides they have their full height, and the block takes the
    // rest of the side.
    for (unsigned int row = 0; row < rows; ++row)
      {
        place(in_row(last, row), Point<2>(lengths[0], row * height), far_second_side);
        place(in_row(first, row), Point<2>(row * height, lengths[1]), far_first_side);
      }
    for (unsigned int j = 0; j <= n[1]; ++j)
      place(in_block(n[0], j), Point<2>(lengths[0], block[1][j]), far_second_side);
    for (unsigned int i = 0; i <= n[0]; ++i)
      place(in_block(i, n[1]), Point<2>(block[0][i], lengths[1]), far_first_side);

    // Sizes of the cells in the undistorted lattice, from which smooth() takes its weights.
    std::vector<std::array<double, 2>> sizes;
    const auto                         add =
      [&](const std::array<unsigned int, 4> &v, const double width, const double high) {
        CellData<2> cell;
        std::copy(v.begin(), v.end(), cell.vertices.begin());
        cells.push_back(cell);
        sizes.push_back({{width, high}});
      };
    for (unsigned int j = 0; j < n[1]; ++j)
      for (unsigned int i = 0; i < n[0]; ++i)
        add({{in_block(i, j), in_block(i + 1, j), in_block(i, j + 1), in_block(i + 1, j + 1)}},
            block[0][i + 1] - block[0][i],
            block[1][j + 1] - block[1][j]);
    for (unsigned int row = 0; row < rows; ++row)
      for (int p = first; p < last; ++p)
        add({{in_row(p, row), in_row(p + 1, row), in_row(p, row + 1), in_row(p + 1, row + 1)}},
            p >= 0 ? along[0][p + 1] - along[0][p] : along[1][-p] - along[1][-p - 1],
            height);

    smooth(points, prescribed, cells, sizes);
  }
} // namespace Touchstone
