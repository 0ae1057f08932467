// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/body_mesh.h>

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <unistd.h>

// Tools that geometries share to make coarse meshes: structured blocks, graded positions,
// boundary faces with their ids, and checks of size and orientation. The meshes of all bodies are
// joined by Forest.
namespace Touchstone
{
  using namespace dealii;

  void
  check_number_of_cells(const double n)
  {
    // Three unknowns per cell and more must have 32-bit numbers, and each rank keeps the
    // coarse mesh, at some hundred bytes per cell.
    const double numbers = std::numeric_limits<int>::max() / 3.;
    const double memory  = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGESIZE);
    if (n <= std::min(numbers, memory / 500.))
      return;
    std::ostringstream text;
    text << "these are " << n << " cells, more than "
         << (n > numbers ? "can be numbered" : "the memory of this machine can hold");
    throw TooManyCells(text.str());
  }



  /** The number of cells for a refinement factor, at least one; the check comes before the
   * conversion to an integer, which could overflow. */
  unsigned int
  scaled_cells(const unsigned int n, const double factor)
  {
    check_number_of_cells(n * factor);
    return std::max(1l, std::lround(n * factor));
  }



  /** n + 1 positions between the ends such that sizes form a geometric series with the given ratio
   * of the last to the first. Sums of the series instead of its formula, which is 0/0 for ratio
   * one. */
  std::vector<double>
  graded_positions(const double lower, const double upper, const unsigned int n, const double ratio)
  {
    const double q = n > 1 ? std::pow(ratio, 1. / (n - 1)) : 1.;

    std::vector<double> sum(n + 1, 0.);
    for (unsigned int i = 0; i < n; ++i)
      sum[i + 1] = sum[i] + std::pow(q, i);

    std::vector<double> positions(n + 1);
    for (unsigned int i = 0; i <= n; ++i)
      positions[i] = lower + (upper - lower) * (sum[i] / sum[n]);
    return positions;
  }



  BodyMesh
  make_block(const std::array<unsigned int, 3>                                       &n,
             const bool                                                               closed,
             const std::function<Point<3>(unsigned int, unsigned int, unsigned int)> &position,
             const std::array<types::boundary_id, 6>                                 &ids)
  {
    // A closed block, as a full tube, has its last points in the second direction in common with
    // the first ones: indices are taken modulo the number of points there.
    const std::array<unsigned int, 3> points{{n[0] + 1, closed ? n[1] : n[1] + 1, n[2] + 1}};
    const auto                        vertex = [&](const std::array<unsigned int, 3> &i) {
      return i[0] + points[0] * (i[1] % points[1] + points[1] * i[2]);
    };

    check_number_of_cells(static_cast<double>(n[0]) * n[1] * n[2]);
    BodyMesh mesh;
    for (unsigned int k = 0; k < points[2]; ++k)
      for (unsigned int j = 0; j < points[1]; ++j)
        for (unsigned int i = 0; i < points[0]; ++i)
          mesh.vertices.push_back(position(i, j, k));

    for (unsigned int k = 0; k < n[2]; ++k)
      for (unsigned int j = 0; j < n[1]; ++j)
        for (unsigned int i = 0; i < n[0]; ++i)
          {
            CellData<3> cell;
            for (unsigned int v = 0; v < 8; ++v)
              cell.vertices[v] = vertex({{i + v % 2, j + v / 2 % 2, k + v / 4}});
            mesh.cells.push_back(cell);
          }

    // Boundary faces: on both sides of each direction d, faces over the two other directions; a
    // closed block has no sides in its second direction.
    for (unsigned int d = 0; d < 3; ++d)
      {
        if (d == 1 && closed)
          continue;
        const unsigned int a = (d + 1) % 3, b = (d + 2) % 3;
        for (unsigned int side = 0; side < 2; ++side)
          for (unsigned int j = 0; j < n[b]; ++j)
            for (unsigned int i = 0; i < n[a]; ++i)
              {
                CellData<2> face;
                face.boundary_id = ids[2 * d + side];
                for (unsigned int v = 0; v < 4; ++v)
                  {
                    std::array<unsigned int, 3> index;
                    index[d]         = side * n[d];
                    index[a]         = i + v % 2;
                    index[b]         = j + v / 2;
                    face.vertices[v] = vertex(index);
                  }
                mesh.subcells.boundary_quads.push_back(face);
              }
      }
    return mesh;
  }



  FaceVertices
  face_of_cell(const std::vector<unsigned int> &cell, const unsigned int f)
  {
    FaceVertices face;
    for (unsigned int v = 0; v < 4; ++v)
      face[v] = cell[GeometryInfo<3>::face_to_cell_vertices(f, v)];
    return face;
  }



  FaceVertices
  sorted_face(const std::vector<unsigned int> &cell, const unsigned int f)
  {
    FaceVertices face = face_of_cell(cell, f);
    std::sort(face.begin(), face.end());
    return face;
  }



  /** Faces that belong to one cell only. They are compared by their sorted vertices, since
   * neighbours list the vertices of a common face in different orders; a face of three cells is
   * no body. */
  std::vector<FaceVertices>
  boundary_faces(const std::vector<CellData<3>> &cells)
  {
    struct Seen
    {
      FaceVertices face;
      unsigned int cells = 0;
    };
    std::map<FaceVertices, Seen> faces;
    for (const CellData<3> &cell : cells)
      for (const unsigned int f : GeometryInfo<3>::face_indices())
        {
          Seen &seen = faces[sorted_face(cell.vertices, f)];
          seen.face  = face_of_cell(cell.vertices, f);
          if (++seen.cells > 2)
            throw std::runtime_error("a face belongs to more than two cells");
        }

    std::vector<FaceVertices> result;
    for (const auto &[sorted, seen] : faces)
      if (seen.cells == 1)
        result.push_back(seen.face);
    return result;
  }



  void
  add_boundary_faces(
    BodyMesh &mesh,
    const std::function<std::pair<types::boundary_id, types::manifold_id>(const FaceVertices &)>
      &classify)
  {
    for (const FaceVertices &vertices : boundary_faces(mesh.cells))
      {
        CellData<2> face;
        std::copy(vertices.begin(), vertices.end(), face.vertices.begin());
        std::tie(face.boundary_id, face.manifold_id) = classify(vertices);
        mesh.subcells.boundary_quads.push_back(face);
      }
  }



  /** Count cells with a negative Jacobian at all corners (numbered inside out) and those with a
   * sign that changes or vanishes (distorted). For trilinear cells the corners are where the
   * Jacobian is worst in practice; the threshold is relative to the lengths of the edges, as flat
   * corners give round-off of either sign. */
  Orientation
  orientation(const BodyMesh &mesh)
  {
    Orientation result;
    for (const CellData<3> &cell : mesh.cells)
      {
        unsigned int positive = 0, negative = 0;
        for (unsigned int v = 0; v < 8; ++v)
          {
            // The edges that leave corner v, each in its coordinate's direction.
            std::array<Tensor<1, 3>, 3> edge;
            double                      scale = 1.;
            for (unsigned int d = 0; d < 3; ++d)
              {
                const unsigned int bit = 1u << d;
                edge[d] =
                  mesh.vertices[cell.vertices[v | bit]] - mesh.vertices[cell.vertices[v & ~bit]];
                scale *= edge[d].norm();
              }
            const double jacobian = edge[0] * cross_product_3d(edge[1], edge[2]);
            positive += jacobian > 1e-10 * scale;
            negative += jacobian < -1e-10 * scale;
          }
        result.negative += negative == 8;
        result.distorted += positive < 8 && negative < 8;
      }
    return result;
  }



  void
  create_triangulation(const BodyMesh &mesh, Triangulation<3> &triangulation)
  {
    triangulation.create_triangulation(mesh.vertices, mesh.cells, mesh.subcells);

    // The ids of the faces are there now, but deal.II leaves edges flat, and so
    // the faces between cells. Boundary faces come last, so that their manifold takes precedence.
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
      if (cell->manifold_id() != numbers::flat_manifold_id)
        {
          for (const auto &face : cell->face_iterators())
            if (face->manifold_id() == numbers::flat_manifold_id)
              face->set_manifold_id(cell->manifold_id());
          for (const unsigned int l : cell->line_indices())
            cell->line(l)->set_manifold_id(cell->manifold_id());
        }
    for (const auto &cell : triangulation.cell_iterators_on_level(0))
      for (const auto &face : cell->face_iterators())
        // Not those that have that of their cell: their edges may be those of such a face.
        if (face->at_boundary() && face->manifold_id() != numbers::flat_manifold_id &&
            face->manifold_id() != cell->manifold_id())
          face->set_all_manifold_ids(face->manifold_id());

    for (const auto &[id, manifold] : mesh.manifolds)
      triangulation.set_manifold(id, *manifold);
  }
} // namespace Touchstone
