// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/body_mesh.h>
#include <touchstone/mesh/mesh_text.h>
#include <touchstone/mesh/named_arrays.h>

#include <algorithm>
#include <set>

// Boundaries and sets of nodes of VTK files, legacy and XML, which have no names but those of
// their arrays.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The faces of cells all of whose corners are marked. */
    void
    add_boundary_of_points(MeshFile &mesh, const std::vector<double> &marks, MeshFile::Group &group)
    {
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        for (const unsigned int f : GeometryInfo<3>::face_indices())
          {
            const FaceVertices face = face_of_cell(mesh.cells[c].vertices, f);
            if (std::all_of(face.begin(), face.end(), [&](const unsigned int v) {
                  return marks[v] != 0.;
                }))
              {
                group.members.push_back(mesh.faces.size());
                mesh.add_face(face, mesh.cell_lines[c]);
              }
          }
    }



    /** The marked points, of which no four are a face: nodes of an edge, for example. @return
     * whether there are any. */
    bool
    add_node_set(MeshFile &mesh, const std::vector<double> &marks, const std::string &name)
    {
      std::set<unsigned int> nodes;
      for (unsigned int v = 0; v < marks.size(); ++v)
        if (marks[v] != 0.)
          nodes.insert(v);
      if (!nodes.empty())
        mesh.node_sets[name] = nodes;
      return !nodes.empty();
    }
  } // namespace



  void
  NamedArrays::add_boundaries(MeshFile &mesh, const std::vector<std::string> &names) const
  {
    // Behind the numbers that fields of the faces give.
    unsigned int next = 1;
    for (const MeshFile::Group &group : mesh.surfaces)
      next = std::max(next, group.number + 1);
    for (const std::string &name : names)
      {
        MeshFile::Group group{next++, name, {}};
        if (const auto points = of_points.find(name); points != of_points.end())
          {
            add_boundary_of_points(mesh, points->second, group);
            if (group.members.empty() && add_node_set(mesh, points->second, name))
              continue;
          }
        else if (const auto cells = of_cells.find(name); cells != of_cells.end())
          {
            for (unsigned int f = 0; f < cell_of_face.size(); ++f)
              if (cells->second[cell_of_face[f]] != 0.)
                group.members.push_back(f);
          }
        else
          throw MeshFileError("The file has no array '" + name +
                                "' of one component in PointData or CellData.",
                              "name arrays of the file in 'Boundary arrays'; it has " + known +
                                ".");
        if (group.members.empty())
          throw MeshFileError(
            "The array '" + name + "' marks no face and no point.",
            "give it other values than 0 at all corners of faces, at points, or in quadrilateral cells");
        // A face that a named array marks leaves the numbers of the fields.
        for (MeshFile::Group &other : mesh.surfaces)
          if (other.name.empty())
            other.members.erase(std::remove_if(other.members.begin(),
                                               other.members.end(),
                                               [&](const unsigned int f) {
                                                 return std::binary_search(group.members.begin(),
                                                                           group.members.end(),
                                                                           f);
                                               }),
                                other.members.end());
        mesh.surfaces.push_back(group);
      }
  }
} // namespace Touchstone
