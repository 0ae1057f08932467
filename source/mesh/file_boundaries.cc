// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/exact_surface.h>
#include <touchstone/mesh/file_geometry.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

// The boundaries of a body from a mesh file: faces get ids from the surfaces that the file marks,
// and the exact surfaces that the input names.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Boundary id of faces that the file does not mark. */
    constexpr types::boundary_id unmarked = 0;
  } // namespace



  /** Give each boundary face the id of the surface of the file to which it belongs. Faces are
   * compared by sorted vertices. Faces of the file between two cells, or of other volumes, are
   * ignored. */
  void
  FileGeometry::mark(BodyMesh                                   &mesh,
                     const MeshFile                             &mesh_file,
                     const std::map<unsigned int, unsigned int> &vertex_numbers,
                     const std::string                          &section) const
  {
    std::map<FaceVertices, std::set<types::boundary_id>> marks;
    types::boundary_id                                   next = unmarked + 1;
    for (const MeshFile::Group &group : mesh_file.surfaces)
      {
        // Ids for shared faces begin behind the highest number of the file.
        next = std::max(next, group.number + 1);
        for (const unsigned int f : group.members)
          {
            FaceVertices face{};
            bool         belongs = true;
            for (unsigned int v = 0; v < 4 && belongs; ++v)
              {
                const auto found = vertex_numbers.find(mesh_file.faces[f][v]);
                belongs          = found != vertex_numbers.end();
                if (belongs)
                  face[v] = found->second;
              }
            std::sort(face.begin(), face.end());
            if (belongs)
              marks[face].insert(group.number);
          }
      }

    std::set<types::boundary_id>                               used;
    std::map<std::set<types::boundary_id>, types::boundary_id> shared_ids;
    add_boundary_faces(mesh, [&](FaceVertices face) {
      std::sort(face.begin(), face.end());
      const auto found = marks.find(face);
      const auto of = found != marks.end() ? found->second : std::set<types::boundary_id>{unmarked};
      used.insert(of.begin(), of.end());
      if (of.size() == 1)
        return std::make_pair(*of.begin(), numbers::flat_manifold_id);
      // A face of several boundaries gets an id of its own, which all of them have.
      const auto [id, is_new] = shared_ids.insert({of, next});
      if (is_new)
        mesh.shared[next++] = of;
      return std::make_pair(id->second, numbers::flat_manifold_id);
    });

    if (used.count(unmarked) > 0)
      mesh.boundary_names["unmarked"] = unmarked;
    for (const MeshFile::Group &group : mesh_file.surfaces)
      if (used.count(group.number) > 0 && !group.name.empty())
        mesh.boundary_names[group.name] = group.number;
    // Names from the input for formats that have numbers only, checked like those of the file:
    // they must exist, and must not rename another boundary.
    for (const auto &[name, number] : extra_names)
      {
        if (used.count(number) == 0)
          throw InputError(section,
                           "Boundary names",
                           name + ": " + std::to_string(number),
                           "the body has no boundary of this number",
                           "its numbers are " +
                             Patterns::Tools::to_string(
                               std::vector<unsigned int>(used.begin(), used.end())) +
                             ".");
        const auto [known, is_new] = mesh.boundary_names.insert({name, number});
        if (!is_new && known->second != number)
          throw InputError(section,
                           "Boundary names",
                           name + ": " + std::to_string(number),
                           "the file calls boundary " + std::to_string(known->second) +
                             " by this name",
                           "take another name");
      }
  }



  void
  FileGeometry::attach_exact_surfaces(BodyMesh &mesh, const std::string &section) const
  {
    // Each exact surface becomes the manifold of its faces, for refinement, and the surface
    // from which contact takes gaps. Vertices are moved to it; a vertex farther away than 1e-3
    // of the size of a face tells of wrong parameters, not of rounding in the file.
    types::manifold_id next = 0;
    for (const auto &[name, shape] : parse_exact_surfaces(exact))
      {
        mesh.manifolds[next] = shape.manifold;
        if (name == "cells")
          for (CellData<3> &cell : mesh.cells)
            cell.manifold_id = next;
        else
          {
            const auto found = mesh.boundary_names.find(name);
            if (found == mesh.boundary_names.end())
              throw InputError(section,
                               "Exact surfaces",
                               name,
                               "the body has no boundary of this name",
                               "use a name from the file or from 'Boundary names'");
            // With the faces that it shares with others.
            std::set<types::boundary_id> ids{found->second};
            for (const auto &[id, of] : mesh.shared)
              if (of.count(found->second) > 0)
                ids.insert(id);
            for (const types::boundary_id id : ids)
              mesh.surfaces[id] = shape.surface;

            double farthest = 0., size = 0.;
            for (CellData<2> &face : mesh.subcells.boundary_quads)
              if (ids.count(face.boundary_id) > 0)
                {
                  face.manifold_id = next;
                  for (const unsigned int v : face.vertices)
                    {
                      // Files round coordinates to few digits; the formula is exact.
                      Point<3>      &x     = mesh.vertices[v];
                      const Point<3> exact = shape.surface->project(x);
                      farthest             = std::max(farthest, exact.distance(x));
                      x                    = exact;
                    }
                  size = std::max(size,
                                  mesh.vertices[face.vertices[0]].distance(
                                    mesh.vertices[face.vertices[3]]));
                }
            if (farthest > 1e-3 * size)
              throw InputError(section,
                               "Exact surfaces",
                               name,
                               "the surface is " + Patterns::Tools::to_string(farthest) +
                                 " away from a vertex of the boundary",
                               "check axis, point, radius and slope");
          }
        ++next;
      }
  }
} // namespace Touchstone
