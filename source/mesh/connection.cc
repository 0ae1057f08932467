// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/connection.h>

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <array>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <limits>
#include <locale>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

// Meshes whose nodes were not merged between cells or parts: they look like a body, and are none.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Vertices on the boundary of a body that lie where others lie: the cells of both are not
     * connected there. */
    struct CoincidentVertices
    {
      /** How many lie where another one lies, and the first of them by position. */
      unsigned int n = 0;
      Point<3>     first;
      /** The connected parts of the body, and whether there are such vertices between them. */
      unsigned int n_parts       = 0;
      bool         between_parts = false;
    };



    double
    shortest_edge(const BodyMesh &mesh)
    {
      double result = std::numeric_limits<double>::max();
      for (const CellData<3> &cell : mesh.cells)
        for (unsigned int e = 0; e < GeometryInfo<3>::lines_per_cell; ++e)
          result = std::min(
            result,
            mesh.vertices[cell.vertices[GeometryInfo<3>::line_to_cell_vertices(e, 0)]].distance(
              mesh.vertices[cell.vertices[GeometryInfo<3>::line_to_cell_vertices(e, 1)]]));
      return result;
    }



    /** For each vertex one that its connected part has in common. */
    std::vector<std::size_t>
    roots(const BodyMesh &mesh)
    {
      boost::disjoint_sets_with_storage<> parts(mesh.vertices.size());
      for (const CellData<3> &cell : mesh.cells)
        for (const unsigned int v : cell.vertices)
          parts.union_set(cell.vertices[0], v);
      std::vector<std::size_t> result;
      for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
        result.push_back(parts.find_set(v));
      return result;
    }



    /** Pairs of vertices that are closer than @p tolerance. A vertex is in all boxes of a grid that
     * its surroundings touch, most are in one. */
    std::set<std::pair<unsigned int, unsigned int>>
    close_pairs(const BodyMesh               &mesh,
                const std::set<unsigned int> &vertices,
                const double                  tolerance)
    {
      std::vector<std::pair<std::array<double, 3>, unsigned int>> in_boxes;
      const double                                                width = 8. * tolerance;
      for (const unsigned int v : vertices)
        {
          std::array<double, 3> low;
          std::array<bool, 3>   also_next;
          for (unsigned int d = 0; d < 3; ++d)
            {
              low[d]       = std::floor((mesh.vertices[v][d] - tolerance) / width);
              also_next[d] = std::floor((mesh.vertices[v][d] + tolerance) / width) > low[d];
            }
          // Counted in integers: far away the next number after that of a box is the same one.
          for (int i = 0; i <= also_next[0]; ++i)
            for (int j = 0; j <= also_next[1]; ++j)
              for (int k = 0; k <= also_next[2]; ++k)
                in_boxes.push_back({{{low[0] + i, low[1] + j, low[2] + k}}, v});
        }
      std::sort(in_boxes.begin(), in_boxes.end());
      std::set<std::pair<unsigned int, unsigned int>> result;
      for (auto a = in_boxes.begin(); a != in_boxes.end(); ++a)
        for (auto b = a + 1; b != in_boxes.end() && b->first == a->first; ++b)
          if (mesh.vertices[a->second].distance(mesh.vertices[b->second]) < tolerance)
            result.insert({a->second, b->second});
      return result;
    }



    CoincidentVertices
    coincident_vertices(const BodyMesh &mesh)
    {
      std::set<unsigned int> on_boundary;
      for (const CellData<2> &face : mesh.subcells.boundary_quads)
        on_boundary.insert(face.vertices.begin(), face.vertices.end());
      const auto         pairs = close_pairs(mesh, on_boundary, 1e-6 * shortest_edge(mesh));
      CoincidentVertices result;
      if (pairs.empty())
        return result;
      const std::vector<std::size_t>     root = roots(mesh);
      std::vector<std::array<double, 3>> places;
      std::set<unsigned int>             coincide;
      const std::set<std::size_t>        parts(root.begin(), root.end());
      for (const auto &[v, w] : pairs)
        {
          const Point<3> &x = mesh.vertices[v];
          places.push_back({{x[0], x[1], x[2]}});
          coincide.insert({v, w});
          result.between_parts = result.between_parts || root[v] != root[w];
        }
      const auto &first = *std::min_element(places.begin(), places.end());
      result.n          = coincide.size();
      result.first      = Point<3>(first[0], first[1], first[2]);
      result.n_parts    = parts.size();
      return result;
    }
  } // namespace



  std::string
  check_connection(const BodyMesh    &mesh,
                   const ForestInput &input,
                   const unsigned int body,
                   const std::string &section)
  {
    const CoincidentVertices found = coincident_vertices(mesh);
    if (found.n == 0)
      return "";
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << found.n << " nodes of its mesh lie where others do, the first at (" << found.first[0]
         << ", " << found.first[1] << ", " << found.first[2]
         << "), and the cells of both are not connected";
    // General contact is no pair; it needs explicit dynamics.
    bool meets_itself = input.computes_ghosts;
    for (const ForestInput::Pair &pair : input.pairs)
      meets_itself = meets_itself || (pair.slave_body == body && pair.master_body == body &&
                                      !pair.master_boundaries.empty());
    if (found.between_parts && !meets_itself)
      throw InputError(section,
                       "",
                       "",
                       text.str() + ": the body falls apart into " + std::to_string(found.n_parts) +
                         " parts",
                       "merge coincident nodes in the program that made the mesh, or make each "
                       "part a body of its own");
    return "Body '" + input.bodies[body].name + "': " + text.str() +
           ". Merge coincident nodes of the mesh unless a crack or contact is meant there.";
  }
} // namespace Touchstone
