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
    Lattice lattice;
    lattice.arc    = numbers::PI / 4. * radius;
    lattice.half   = fillet_half;
    lattice.rows   = rows;
    lattice.height = lattice.arc / fillet_half;
    for (unsigned int d = 0; d < 2; ++d)
      {
        lattice.n[d] = straight[d] + fillet_half;
        lattice.along[d] =
          path(lattice.arc, fillet_half, lengths[d] - radius, straight[d], grading);
        // On the opposite side the block begins after the rows.
        const double begin = rows * lattice.height;
        for (const double s : lattice.along[d])
          lattice.block[d].push_back(begin + (lengths[d] - begin) * s / lattice.along[d].back());
      }
    points.resize(lattice.n_points());
    const std::vector<bool> prescribed = place_outline(lattice, lengths, radius);
    smooth(points, prescribed, cells, add_cells(lattice));
  }



  std::vector<bool>
  RoundedRectangle::place_outline(const Lattice               &l,
                                  const std::array<double, 2> &lengths,
                                  const double                 radius)
  {
    const int         half = l.half;
    std::vector<bool> prescribed(points.size(), false);
    const auto place = [&](const unsigned int v, const Point<2> &x, std::set<unsigned int> &part) {
      points[v]     = x;
      prescribed[v] = true;
      part.insert(v);
    };
    for (int p = l.first(); p <= l.last(); ++p)
      {
        const unsigned int v = l.in_row(p, 0);
        // Ends of the rounding are placed as points of the sides.
        if (std::abs(p) <= half)
          {
            const double angle = numbers::PI / 4. * (5. + static_cast<double>(p) / half);
            place(v,
                  Point<2>(radius + radius * std::cos(angle), radius + radius * std::sin(angle)),
                  fillet);
          }
        if (p >= half)
          place(v, Point<2>(radius - l.arc + l.along[0][p], 0.), first_side);
        if (p <= -half)
          place(v, Point<2>(0., radius - l.arc + l.along[1][-p]), second_side);
      }
    // Where the rows end on the far sides they have their full height, and the block takes the
    // rest of the side.
    for (unsigned int row = 0; row < l.rows; ++row)
      {
        place(l.in_row(l.last(), row), Point<2>(lengths[0], row * l.height), far_second_side);
        place(l.in_row(l.first(), row), Point<2>(row * l.height, lengths[1]), far_first_side);
      }
    for (unsigned int j = 0; j <= l.n[1]; ++j)
      place(l.in_block(l.n[0], j), Point<2>(lengths[0], l.block[1][j]), far_second_side);
    for (unsigned int i = 0; i <= l.n[0]; ++i)
      place(l.in_block(i, l.n[1]), Point<2>(l.block[0][i], lengths[1]), far_first_side);
    return prescribed;
  }



  std::vector<std::array<double, 2>>
  RoundedRectangle::add_cells(const Lattice &l)
  {
    std::vector<std::array<double, 2>> sizes;
    const auto                         add =
      [&](const std::array<unsigned int, 4> &v, const double width, const double high) {
        CellData<2> cell;
        std::copy(v.begin(), v.end(), cell.vertices.begin());
        cells.push_back(cell);
        sizes.push_back({{width, high}});
      };
    for (unsigned int j = 0; j < l.n[1]; ++j)
      for (unsigned int i = 0; i < l.n[0]; ++i)
        add({{l.in_block(i, j),
              l.in_block(i + 1, j),
              l.in_block(i, j + 1),
              l.in_block(i + 1, j + 1)}},
            l.block[0][i + 1] - l.block[0][i],
            l.block[1][j + 1] - l.block[1][j]);
    for (unsigned int row = 0; row < l.rows; ++row)
      for (int p = l.first(); p < l.last(); ++p)
        add({{l.in_row(p, row),
              l.in_row(p + 1, row),
              l.in_row(p, row + 1),
              l.in_row(p + 1, row + 1)}},
            p >= 0 ? l.along[0][p + 1] - l.along[0][p] : l.along[1][-p] - l.along[1][-p - 1],
            l.height);
    return sizes;
  }
} // namespace Touchstone
