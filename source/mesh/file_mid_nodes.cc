// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/body_mesh.h>
#include <touchstone/mesh/file_geometry.h>
#include <touchstone/mesh/quadratic_manifold.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/patterns.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <stdexcept>

// The shape of a body whose mesh file has hexahedra of 20 or 27 nodes: edges, faces and cells get
// the middle nodes that the file gives or, where it does not, those of the serendipity functions,
// and a manifold makes refined cells and mappings of degree 2 follow them.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    using Edge = std::array<unsigned int, 2>;

    /** Mid nodes that are so close to the middle are there, relative to the length of the edge:
     * files round their numbers. */
    constexpr double straight = 1e-6;

    /** For each of the 27 nodes, the vertices whose mean it is in a cube. */
    std::array<std::vector<unsigned int>, 27>
    vertices_around_nodes()
    {
      std::array<std::vector<unsigned int>, 27> result;
      for (unsigned int n = 0; n < 27; ++n)
        for (unsigned int v = 0; v < 8; ++v)
          {
            bool belongs = true;
            for (unsigned int d = 0; d < 3; ++d)
              {
                const unsigned int at = d == 0 ? n % 3 : d == 1 ? n / 3 % 3 : n / 9;
                belongs               = belongs && (at == 1 || at / 2 == (v >> d & 1));
              }
            if (belongs)
              result[n].push_back(v);
          }
      return result;
    }



    /** The nodes of all cells, by the vertices around them. */
    class MidNodes
    {
    public:
      MidNodes(const std::vector<Point<3>> &vertices)
        : vertices(vertices)
      {
      }

      /** Add the nodes of a cell of the file, whose vertices are in deal.II's order. */
      void
      add(const std::vector<unsigned int> &v, const std::vector<Point<3>> &nodes)
      {
        Point<3> sum_of_edges;
        for (unsigned int e = 0; e < 12; ++e)
          {
            const unsigned int a = v[MeshFile::edge_ends[e][0]], b = v[MeshFile::edge_ends[e][1]];
            const Point<3>     middle = 0.5 * (vertices[a] + vertices[b]);
            const Point<3>     x      = nodes.empty() ? middle : nodes[e];
            const double       length = vertices[a].distance(vertices[b]);
            bulge                     = std::max(bulge, x.distance(middle));
            curved                    = curved || x.distance(middle) > straight * length;
            insert(edges, Edge{{std::min(a, b), std::max(a, b)}}, x, straight * length);
            sum_of_edges += x;
          }
        if (nodes.size() == 19)
          add_inner(v, nodes, sum_of_edges);
        else
          for (const unsigned int f : GeometryInfo<3>::face_indices())
            {
              FaceVertices face = sorted_face(v, f);
              const auto   x    = serendipity(face);
              insert(faces, face, x, straight * vertices[face[0]].distance(vertices[face[3]]));
            }
        has_inner.push_back(nodes.size() == 19);
        if (nodes.size() < 19)
          inner.emplace_back();
      }

      /** Put the nodes of these faces on the surface. */
      void
      project(const FaceVertices &face, const AnalyticSurface &surface)
      {
        FaceVertices sorted = face;
        std::sort(sorted.begin(), sorted.end());
        faces.at(sorted) = surface.project(faces.at(sorted));
        for (unsigned int i = 0; i < 4; ++i)
          for (unsigned int j = i + 1; j < 4; ++j)
            if (const auto edge = edges.find(Edge{{sorted[i], sorted[j]}}); edge != edges.end())
              edge->second = surface.project(edge->second);
      }

      /** The nodes of cell @p c, whose vertices may have been numbered anew. */
      QuadraticCell
      cell(const unsigned int c, const std::vector<unsigned int> &v) const
      {
        static const auto around = vertices_around_nodes();
        QuadraticCell     result;
        Point<3>          corners, middles;
        for (unsigned int n = 0; n < 27; ++n)
          {
            std::vector<unsigned int> of;
            for (const unsigned int k : around[n])
              of.push_back(v[k]);
            std::sort(of.begin(), of.end());
            if (of.size() == 1)
              corners += result[n] = vertices[of[0]];
            else if (of.size() == 2)
              middles += result[n] = edges.at(Edge{{of[0], of[1]}});
            else if (of.size() == 4)
              result[n] = faces.at(FaceVertices{{of[0], of[1], of[2], of[3]}});
          }
        result[13] = has_inner[c] ? inner[c] : Point<3>(0.25 * (middles - corners));
        return result;
      }

      bool   curved = false;
      double bulge  = 0.;

    private:
      const std::vector<Point<3>>     &vertices;
      std::map<Edge, Point<3>>         edges;
      std::map<FaceVertices, Point<3>> faces;
      /** Of the cells. */
      std::vector<Point<3>> inner;
      std::vector<bool>     has_inner;

      template <class Key>
      static void
      insert(std::map<Key, Point<3>> &where,
             const Key               &key,
             const Point<3>          &x,
             const double             tolerance)
      {
        const auto [known, is_new] = where.insert({key, x});
        if (!is_new && known->second.distance(x) > tolerance)
          throw std::runtime_error(
            "Two cells have an edge or face in common, but not the node in its middle");
      }

      /** The middle of a face of eight nodes: half the sum of the middle nodes less a quarter of
       * that of the corners. */
      Point<3>
      serendipity(const FaceVertices &sorted) const
      {
        Point<3> x;
        for (unsigned int i = 0; i < 4; ++i)
          {
            x -= 0.25 * Tensor<1, 3>(vertices[sorted[i]]);
            for (unsigned int j = i + 1; j < 4; ++j)
              if (const auto edge = edges.find(Edge{{sorted[i], sorted[j]}}); edge != edges.end())
                x += 0.5 * Tensor<1, 3>(edge->second);
          }
        return x;
      }

      /** The middle nodes of faces and of the cell: formats number them in different orders, but
       * each lies nearest to where the edges let it be expected. */
      void
      add_inner(const std::vector<unsigned int> &v,
                const std::vector<Point<3>>     &nodes,
                const Point<3>                  &sum_of_edges)
      {
        std::vector<FaceVertices> keys;
        std::vector<Point<3>>     expected;
        Point<3>                  corners;
        for (unsigned int k = 0; k < 8; ++k)
          corners += vertices[v[k]];
        for (const unsigned int f : GeometryInfo<3>::face_indices())
          {
            keys.push_back(sorted_face(v, f));
            expected.push_back(serendipity(keys.back()));
          }
        expected.push_back(Point<3>(0.25 * (sum_of_edges - corners)));
        std::set<unsigned int> used;
        for (unsigned int n = 12; n < 19; ++n)
          {
            unsigned int nearest = 0;
            for (unsigned int k = 1; k < 7; ++k)
              if (nodes[n].distance(expected[k]) < nodes[n].distance(expected[nearest]))
                nearest = k;
            if (!used.insert(nearest).second)
              throw std::runtime_error("The nodes in the middle of the faces of a cell do not lie "
                                       "there");
            const double off  = nodes[n].distance(expected[nearest]),
                         size = vertices[v[0]].distance(vertices[v[7]]);
            curved            = curved || off > straight * size;
            bulge             = std::max(bulge, off);
            if (nearest == 6)
              inner.push_back(nodes[n]);
            else
              insert(faces, keys[nearest], nodes[n], straight * size);
          }
      }
    };



    /** Cells whose Jacobian is not positive at each node. */
    unsigned int
    n_inverted(const std::vector<QuadraticCell> &cells)
    {
      unsigned int result = 0;
      for (const QuadraticCell &cell : cells)
        {
          bool positive = true;
          for (unsigned int n = 0; n < 27; ++n)
            {
              Tensor<2, 3> jacobian;
              evaluate(cell, Point<3>(n % 3 / 2., n / 3 % 3 / 2., n / 9 / 2.), jacobian);
              const double scale = transpose(jacobian)[0].norm() * transpose(jacobian)[1].norm() *
                                   transpose(jacobian)[2].norm();
              positive = positive && determinant(jacobian) > 1e-10 * scale;
            }
          result += !positive;
        }
      return result;
    }
  } // namespace



  void
  FileGeometry::curve(BodyMesh                                   &mesh,
                      const MeshFile                             &mesh_file,
                      const std::map<unsigned int, unsigned int> &vertex_numbers,
                      const std::vector<unsigned int>            &cell_numbers,
                      const std::string                          &section) const
  {
    const auto refuse = [&](const std::string &problem, const std::string &remedy) {
      throw InputError(section, "File", file, problem, remedy);
    };
    if (std::all_of(cell_numbers.begin(), cell_numbers.end(), [&](const unsigned int c) {
          return mesh_file.mid_nodes[c].empty();
        }))
      return;

    // The file's positions of vertices: exact surfaces have moved those of the mesh, by which
    // straight edges would look curved.
    std::vector<Point<3>> vertices(mesh.vertices.size());
    for (const auto &[in_file, v] : vertex_numbers)
      vertices[v] = mesh_file.vertices[in_file];
    MidNodes nodes(vertices);
    try
      {
        for (const unsigned int c : cell_numbers)
          {
            std::vector<unsigned int> v;
            for (const unsigned int in_file : mesh_file.cells[c].vertices)
              v.push_back(vertex_numbers.at(in_file));
            std::vector<Point<3>> of_cell;
            for (const unsigned int n : mesh_file.mid_nodes[c])
              of_cell.push_back(mesh_file.vertices[n]);
            nodes.add(v, of_cell);
          }
      }
    catch (const std::runtime_error &error)
      {
        refuse(error.what(),
               "use cells of one number of nodes, of 20 or of 27, and give them common nodes");
      }
    if (!nodes.curved)
      return;

    vertices = mesh.vertices;
    for (const CellData<2> &face : mesh.subcells.boundary_quads)
      if (const auto surface = mesh.surfaces.find(face.boundary_id); surface != mesh.surfaces.end())
        nodes.project({{face.vertices[0], face.vertices[1], face.vertices[2], face.vertices[3]}},
                      *surface->second);
    std::vector<QuadraticCell> cells;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      cells.push_back(nodes.cell(c, mesh.cells[c].vertices));
    if (const unsigned int bad = n_inverted(cells); bad > 0)
      refuse(std::to_string(bad) + " of " + std::to_string(cells.size()) +
               (bad == 1 ? " cells is" : " cells are") +
               " inverted or distorted by the nodes in the middle of edges and faces: the Jacobian "
               "is not positive at each node",
             "repair the mesh in the program that made it, or save it with order 1");

    types::manifold_id id = 0;
    for (const auto &[other, manifold] : mesh.manifolds)
      id = std::max(id, other + 1);
    mesh.manifolds[id] = make_quadratic_manifold(cells);
    for (CellData<3> &cell : mesh.cells)
      // The key 'Exact surfaces' may have given all cells a shape.
      if (cell.manifold_id == numbers::flat_manifold_id)
        cell.manifold_id = id;
    mesh.bulge = nodes.bulge;
  }
} // namespace Touchstone
