// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/base/near_ranks.h>
#include <touchstone/contact/geometry/deformed_cells.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Whether @p x lies in one of the six tetrahedra around the diagonal from the first to the
     * last of the vertices @p c of a cell, in the order of deal.II. */
    bool
    contain(const std::array<Point<dim>, 8> &c, const Point<dim> &x)
    {
      // Vertices 1 to 6 in a closed path along edges of the cell: each edge of the path and the
      // diagonal from vertex 0 to vertex 7 make a tetrahedron. Warped faces are thus replaced by
      // two triangles. This is accurate enough to tell whether bodies overlap and needs no inverse
      // mapping, which may diverge in distorted cells.
      constexpr unsigned int around[7] = {1, 3, 2, 6, 4, 5, 1};
      for (unsigned int k = 0; k < 6; ++k)
        {
          Tensor<2, dim> edges;
          for (unsigned int d = 0; d < dim; ++d)
            {
              edges[d][0] = c[around[k]][d] - c[0][d];
              edges[d][1] = c[around[k + 1]][d] - c[0][d];
              edges[d][2] = c[7][d] - c[0][d];
            }
          if (std::abs(determinant(edges)) == 0.)
            continue;
          // Barycentric coordinates of the point in the tetrahedron; the fourth is one less their
          // sum.
          const Tensor<1, dim> part = invert(edges) * (x - c[0]);
          // On a plane between two of them, as planes of symmetry are, round-off must not put a
          // point outside of both.
          constexpr double on_plane = Tolerances::face_coordinate;
          if (part[0] >= -on_plane && part[1] >= -on_plane && part[2] >= -on_plane &&
              part[0] + part[1] + part[2] <= 1. + on_plane)
            return true;
        }
      return false;
    }



    /** Whether @p x lies in the tetrahedra around any diagonal of the cell: warped faces of a body
     * and of its mirror image are replaced by the same triangles. */
    bool
    contains(const std::array<Point<dim>, 8> &c, const Point<dim> &x)
    {
      // Mirrored along one axis the first vertex is an end of another diagonal.
      constexpr unsigned int mirrors[4] = {0, 1, 2, 4};
      return std::any_of(std::begin(mirrors), std::end(mirrors), [&](const unsigned int mirror) {
        std::array<Point<dim>, 8> mirrored;
        for (unsigned int v = 0; v < 8; ++v)
          mirrored[v] = c[v ^ mirror];
        return contain(mirrored, x);
      });
    }
  } // namespace



  std::array<Point<dim>, 8>
  deformed_vertices(const DoFHandler<dim>::active_cell_iterator &cell, const Vector &u)
  {
    std::array<Point<dim>, 8> result;
    for (unsigned int v = 0; v < 8; ++v)
      {
        result[v] = cell->vertex(v);
        for (unsigned int d = 0; d < dim; ++d)
          result[v][d] += u(cell->vertex_dof_index(v, d));
      }
    return result;
  }



  BoundingBox<dim>
  box_of_cell(const std::array<Point<dim>, 8> &vertices)
  {
    BoundingBox<dim> box(std::vector<Point<dim>>(vertices.begin(), vertices.end()));
    const auto      &ends = box.get_boundary_points();
    box.extend(Tolerances::face_coordinate * ends.first.distance(ends.second));
    return box;
  }



  DeformedCells::DeformedCells(const Solid &solid, const unsigned int body, const Vector &u)
  {
    std::vector<std::pair<Box, std::size_t>> boxes;
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && cell->material_id() == body)
        {
          const std::array<Point<dim>, 8> corners = deformed_vertices(cell, u);
          boxes.emplace_back(box_of_cell(corners), cells.size());
          cells.push_back(corners);
        }
    // Only cells whose bounding box has the point are tested in contain().
    tree = pack_rtree(boxes);
  }



  std::vector<DeformedCells::Box>
  DeformedCells::boxes() const
  {
    std::vector<Box> result;
    for (const auto &entry : tree)
      result.push_back(entry.first);
    return result;
  }



  bool
  DeformedCells::contain(const Point<dim> &x) const
  {
    namespace query = boost::geometry::index;
    for (const auto &entry : tree | query::adaptors::queried(query::intersects(x)))
      if (contains(cells[entry.second], x))
        return true;
    return false;
  }



  std::vector<bool>
  lie_within(const std::vector<Point<dim>> &points,
             const Solid                   &solid,
             const unsigned int             body,
             const Vector                  &u)
  {
    std::vector<bool> result(points.size(), false);
    // No points on any rank, as mostly: no cells need be gathered in trees.
    if (Utilities::MPI::max(points.size(), solid.communicator) == 0)
      return result;
    struct Question
    {
      std::size_t             number;
      std::array<double, dim> x;
    };
    const DeformedCells                              cells(solid, body, u);
    std::vector<DeformedCells::Box>                  at_points;
    std::map<unsigned int, std::vector<Question>>    questions;
    std::map<unsigned int, std::vector<std::size_t>> answers;
    for (const Point<dim> &x : points)
      at_points.push_back(DeformedCells::Box({x, x}));
    const auto ranks = near_ranks(cells.boxes(), at_points, solid.communicator);
    for (std::size_t k = 0; k < points.size(); ++k)
      for (const unsigned int rank : ranks[k])
        questions[rank].push_back({k, {{points[k][0], points[k][1], points[k][2]}}});
    for (const auto &[rank, asked] : exchange_records(questions, solid.communicator))
      for (const Question &one : asked)
        if (cells.contain({one.x[0], one.x[1], one.x[2]}))
          answers[rank].push_back(one.number);
    for (const auto &[rank, numbers] : exchange_records(answers, solid.communicator))
      for (const std::size_t k : numbers)
        result[k] = true;
    return result;
  }



  std::vector<bool>
  lie_within_each_other(const std::vector<std::array<Point<dim>, 2>> &pairs,
                        const Solid                                  &solid,
                        const std::array<unsigned int, 2>            &bodies,
                        const Vector                                 &u)
  {
    std::vector<bool> result(pairs.size(), true);
    for (unsigned int side = 0; side < 2; ++side)
      {
        std::vector<Point<dim>> points;
        for (const auto &pair : pairs)
          points.push_back(pair[side]);
        const std::vector<bool> inside = lie_within(points, solid, bodies[1 - side], u);
        for (std::size_t k = 0; k < pairs.size(); ++k)
          result[k] = result[k] && inside[k];
      }
    return result;
  }
} // namespace Touchstone
