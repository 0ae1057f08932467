// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/body_mesh.h>
#include <touchstone/mesh/mesh_file.h>
#include <touchstone/mesh/mesh_text.h>

#include <deal.II/base/geometry_info.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace Touchstone
{
  using namespace dealii;

  /** File formats number the vertices of a hexahedron around its faces, deal.II in lexicographic
   * order. */
  void
  MeshFile::add_cell(const std::vector<unsigned int> &v, const unsigned int line)
  {
    CellData<3> cell;
    cell.vertices = {v[0], v[1], v[3], v[2], v[4], v[5], v[7], v[6]};
    cells.push_back(cell);
    mid_nodes.emplace_back(v.begin() + 8, v.end());
    cell_lines.push_back(line);
  }



  void
  MeshFile::add_face(const std::array<unsigned int, 4> &corners, const unsigned int line)
  {
    faces.push_back(corners);
    face_lines.push_back(line);
  }



  MeshFile::Group &
  MeshFile::group(std::vector<Group> &groups, const unsigned int number)
  {
    for (Group &group : groups)
      if (group.number == number)
        return group;
    groups.push_back({number, "", {}});
    return groups.back();
  }



  namespace
  {
    /** For each cell the first one in the file that has the same vertices. */
    std::vector<unsigned int>
    first_copies(const std::vector<CellData<3>> &cells)
    {
      // Sorting the cells by their sorted vertices brings copies next to each other, in the order
      // of the file: n log n instead of n^2 comparisons.
      std::vector<std::vector<unsigned int>> sorted(cells.size());
      for (unsigned int c = 0; c < cells.size(); ++c)
        {
          sorted[c] = cells[c].vertices;
          std::sort(sorted[c].begin(), sorted[c].end());
        }
      std::vector<unsigned int> order(cells.size());
      std::iota(order.begin(), order.end(), 0);
      std::vector<unsigned int> first = order;
      std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
        return std::tie(sorted[a], a) < std::tie(sorted[b], b);
      });
      for (unsigned int i = 1; i < order.size(); ++i)
        if (sorted[order[i]] == sorted[order[i - 1]])
          first[order[i]] = first[order[i - 1]];
      return first;
    }
  } // namespace



  /** Gmsh 2.2 writes an element once for each physical group that has it. With @p
   * one_for_each_volume such copies are joined to one cell that is a member of all their volumes;
   * any other two cells with the same vertices are an error, because they would overlap. */
  void
  MeshFile::join_copies(const bool one_for_each_volume)
  {
    const std::vector<unsigned int> first = first_copies(cells);

    // A cell and its copies may have one volume each, and not the same.
    std::vector<unsigned int> copies(cells.size(), 0), volumes_of(cells.size(), 0);
    for (const unsigned int f : first)
      ++copies[f];
    for (Group &volume : volumes)
      {
        std::vector<bool>         known(cells.size(), false);
        std::vector<unsigned int> members;
        for (const unsigned int c : volume.members)
          if (!known[first[c]])
            {
              known[first[c]] = true;
              ++volumes_of[first[c]];
              members.push_back(first[c]);
            }
        volume.members = members;
      }

    // A copy is legitimate only if each copy stands for a volume of its own and lists its
    // vertices in the same order, as Gmsh writes it; else the mesh really has two cells in one
    // place.
    std::vector<unsigned int> number(cells.size()), lines;
    std::vector<CellData<3>>  kept;

    std::vector<std::vector<unsigned int>> kept_mid_nodes;
    for (unsigned int c = 0; c < cells.size(); ++c)
      if (const unsigned int f = first[c]; f == c)
        {
          number[c] = kept.size();
          kept.push_back(cells[c]);
          kept_mid_nodes.push_back(mid_nodes[c]);
          lines.push_back(cell_lines[c]);
        }
      else if (!one_for_each_volume || volumes_of[f] < copies[f] ||
               cells[c].vertices != cells[f].vertices || mid_nodes[c] != mid_nodes[f])
        {
          const std::string same = "This cell has the same nodes as that of " + place + " " +
                                   std::to_string(cell_lines[f]) + ".",
                            remedy = "remove one of the two from the file";
          if (place == "line")
            throw MeshFileError(cell_lines[c], same, remedy);
          throw MeshFileError("Cell of " + place + " " + std::to_string(cell_lines[c]) + ": " +
                                same,
                              remedy);
        }
    cells      = kept;
    mid_nodes  = kept_mid_nodes;
    cell_lines = lines;
    for (Group &volume : volumes)
      for (unsigned int &c : volume.members)
        c = number[c];
  }



  void
  MeshFile::check_faces() const
  {
    std::vector<bool> of_cells(vertices.size(), false);
    for (const CellData<3> &cell : cells)
      for (const unsigned int v : cell.vertices)
        of_cells[v] = true;
    // The faces to be found, by their sorted vertices.
    std::map<FaceVertices, unsigned int> missing;
    for (unsigned int f = 0; f < faces.size(); ++f)
      if (std::all_of(faces[f].begin(), faces[f].end(), [&](const unsigned int v) {
            return of_cells[v];
          }))
        {
          FaceVertices face = faces[f];
          std::sort(face.begin(), face.end());
          missing.insert({face, f});
        }
    for (auto cell = cells.begin(); cell != cells.end() && !missing.empty(); ++cell)
      for (const unsigned int f : GeometryInfo<3>::face_indices())
        missing.erase(sorted_face(cell->vertices, f));
    if (missing.empty())
      return;
    unsigned int first = numbers::invalid_unsigned_int;
    for (const auto &[face, f] : missing)
      first = std::min(first, f);
    throw MeshFileError("The quadrilateral of " + place + " " + std::to_string(face_lines[first]) +
                          " has the corners of hexahedra and is the face of none.",
                        "mesh the surface together with its volume, or save the file without it");
  }
} // namespace Touchstone
