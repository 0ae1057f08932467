// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/mesh_copies.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

// Coarse meshes of bodies that are moved and repeated (placed_geometry.cc), with boundaries,
// manifolds and exact surfaces.
namespace Touchstone
{
  using namespace dealii;

  /** The body in another place. */
  void
  move_mesh(const AffineMap &map, const bool with_surfaces, BodyMesh &mesh)
  {
    for (Point<3> &x : mesh.vertices)
      x = map(x);
    if (map.mirrors())
      // The first direction of each cell the other way round makes it right-handed again.
      for (CellData<3> &cell : mesh.cells)
        for (unsigned int v = 0; v < 8; v += 2)
          std::swap(cell.vertices[v], cell.vertices[v + 1]);
    for (auto &[id, manifold] : mesh.manifolds)
      manifold = mapped_manifold(manifold, map);
    mesh.bulge *= std::cbrt(std::abs(determinant(map.linear())));
    if (with_surfaces)
      for (auto &[id, surface] : mesh.surfaces)
        surface = mapped_surface(surface, map);
  }



  /** Add @p copy to @p mesh. Its boundaries have numbers of their own, since each has an exact
   * surface of its own, and count as those of the same number of @p original. */
  void
  append_copy(const BodyMesh &original, const AffineMap &map, BodyMesh &mesh)
  {
    BodyMesh copy = original;
    move_mesh(map, /*with_surfaces=*/true, copy);

    types::boundary_id next_boundary = 0;
    for (const CellData<2> &face : mesh.subcells.boundary_quads)
      next_boundary = std::max(next_boundary, face.boundary_id + 1);
    for (const auto &[id, of] : mesh.shared)
      next_boundary = std::max(next_boundary, id + 1);
    for (const auto &[name, id] : mesh.boundary_names)
      next_boundary = std::max(next_boundary, id + 1);
    std::map<types::boundary_id, types::boundary_id> boundary_ids;
    for (const CellData<2> &face : copy.subcells.boundary_quads)
      boundary_ids[face.boundary_id] = 0;
    for (auto &[own, id] : boundary_ids)
      {
        id                = next_boundary++;
        const auto shared = original.shared.find(own);
        mesh.shared[id] =
          shared != original.shared.end() ? shared->second : std::set<types::boundary_id>{own};
        if (const auto surface = copy.surfaces.find(own); surface != copy.surfaces.end())
          mesh.surfaces[id] = surface->second;
      }

    types::manifold_id next_manifold = 0;
    for (const auto &[id, manifold] : mesh.manifolds)
      next_manifold = std::max(next_manifold, id + 1);
    std::map<types::manifold_id, types::manifold_id> manifold_ids;
    for (const auto &[id, manifold] : copy.manifolds)
      {
        manifold_ids[id]              = next_manifold;
        mesh.manifolds[next_manifold] = manifold;
        ++next_manifold;
      }
    manifold_ids[numbers::flat_manifold_id] = numbers::flat_manifold_id;

    const unsigned int first = mesh.vertices.size();
    for (const auto &[name, members] : original.node_sets)
      for (const unsigned int v : members)
        mesh.node_sets[name].insert(first + v);
    mesh.vertices.insert(mesh.vertices.end(), copy.vertices.begin(), copy.vertices.end());
    for (CellData<3> cell : copy.cells)
      {
        for (unsigned int &v : cell.vertices)
          v += first;
        cell.manifold_id = manifold_ids.at(cell.manifold_id);
        mesh.cells.push_back(cell);
      }
    for (CellData<2> face : copy.subcells.boundary_quads)
      {
        for (unsigned int &v : face.vertices)
          v += first;
        face.boundary_id = boundary_ids.at(face.boundary_id);
        face.manifold_id = manifold_ids.at(face.manifold_id);
        mesh.subcells.boundary_quads.push_back(face);
      }
  }



  /** Whether vertices of different copies, of so many vertices each, lie in one place. Two points
   * that are closer than half a width have the same place in a grid of that width, or in one of
   * those that are shifted by half of it. */
  bool
  vertices_coincide(const BodyMesh &mesh, const std::size_t of_each, const double tolerance)
  {
    std::set<unsigned int> on_boundary;
    for (const CellData<2> &face : mesh.subcells.boundary_quads)
      on_boundary.insert(face.vertices.begin(), face.vertices.end());
    for (unsigned int shift = 0; shift < 8; ++shift)
      {
        std::map<std::array<double, 3>, std::size_t> places;
        for (const unsigned int v : on_boundary)
          {
            std::array<double, 3> place;
            for (unsigned int d = 0; d < 3; ++d)
              place[d] = std::floor(mesh.vertices[v][d] / (4. * tolerance) +
                                    ((shift >> d & 1) != 0U ? 0.5 : 0.));
            if (places.emplace(place, v / of_each).first->second != v / of_each)
              return true;
          }
      }
    return false;
  }
} // namespace Touchstone
