// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_named_arrays_h
#define touchstone_mesh_named_arrays_h

#include <touchstone/mesh/mesh_file.h>

#include <map>
#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Arrays of one component of a VTK file, by name: a number for each point or for each
   * cell.
   */
  struct NamedArrays
  {
    std::map<std::string, std::vector<double>> of_points, of_cells;
    /** What the file has, for messages. */
    std::string known;
    /** The cell of the file that each face of the mesh is. */
    std::vector<unsigned int> cell_of_face;

    /**
     * @brief Make a boundary of each of the @p names: the faces all of whose corners, or that
     * themselves, have other values than zero; or a set of nodes, where an array marks points
     * but no whole face.
     * @throws MeshFileError if there is no such array, or it marks nothing.
     */
    void
    add_boundaries(MeshFile &mesh, const std::vector<std::string> &names) const;
  };
} // namespace Touchstone

#endif
