// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_mesh_file_h
#define touchstone_mesh_mesh_file_h

#include <deal.II/base/point.h>
#include <deal.II/grid/tria_description.h>

#include <array>
#include <iosfwd>
#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief What a mesh file holds: hexahedra, marked faces, and their groups.
   *
   * deal.II's GridIn is not used because it drops the names of groups and
   * refuses marked faces inside the mesh, which files with several bodies have.
   */
  struct MeshFile
  {
    /** @brief Cells or faces with a common name and number. */
    struct Group
    {
      unsigned int number;
      /** May be empty. */
      std::string name;
      /** Indices into cells or faces. */
      std::vector<unsigned int> members;
    };

    std::vector<dealii::Point<3>> vertices;
    /** With vertices in deal.II's order. */
    std::vector<dealii::CellData<3>> cells;
    /** Lines of the file where the cells stand, for messages. */
    std::vector<unsigned int> cell_lines;
    /** Vertices of marked faces in any order. */
    std::vector<std::array<unsigned int, 4>> faces;
    std::vector<Group>                       volumes, surfaces;

    /** @brief Add a hexahedron with its vertices in the order of Gmsh, Abaqus
     * and VTK: around the bottom, then around the top.
     * @param line Where the file has it. */
    void
    add_cell(const std::vector<unsigned int> &vertices, unsigned int line);

    /** @brief The group with this number, or a new one. */
    static Group &
    group(std::vector<Group> &groups, unsigned int number);

    /** @brief Refuse two cells with the same nodes, which would overlap.
     * @param one_for_each_volume Whether cells of different volumes may be copies, which become
     *   one cell of several volumes: so Gmsh's version 2 writes physical volumes that overlap.
     * @throws MeshFileError that names both lines */
    void
    join_copies(bool one_for_each_volume);
  };

  /** @brief Read Gmsh .msh, version 2.x or 4.1, ASCII.
   * @throws MeshFileError with a sentence that says what is wrong and where. */
  MeshFile
  read_gmsh(std::istream &in);

  /** @brief Read an Abaqus .inp with C3D8 elements, ELSETs and SURFACEs.
   * @throws MeshFileError */
  MeshFile
  read_abaqus(std::istream &in);

  /** @brief Read a legacy VTK file, ASCII, with an unstructured grid.
   * @throws MeshFileError */
  MeshFile
  read_vtk(std::istream &in);
} // namespace Touchstone

#endif
