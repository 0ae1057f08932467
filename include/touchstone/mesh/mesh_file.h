// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_mesh_file_h
#define touchstone_mesh_mesh_file_h

#include <deal.II/base/point.h>
#include <deal.II/grid/tria_description.h>

#include <array>
#include <iosfwd>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief What a mesh file holds: hexahedra, marked faces, their groups, and named sets of nodes.
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
    /** For each cell its 12 nodes in the middle of edges, in VTK's order, and behind them those in
     * the middle of its faces and the one of the cell, in any order: 12 or 19, or none. */
    std::vector<std::vector<unsigned int>> mid_nodes;
    /** The vertices at the ends of each edge of a cell: edges in VTK's order, vertices in
     * deal.II's. */
    static constexpr unsigned int edge_ends[12][2] = {{0, 1},
                                                      {1, 3},
                                                      {3, 2},
                                                      {2, 0},
                                                      {4, 5},
                                                      {5, 7},
                                                      {7, 6},
                                                      {6, 4},
                                                      {0, 4},
                                                      {1, 5},
                                                      {3, 7},
                                                      {2, 6}};
    /** Places of the file where the cells stand, for messages. */
    std::vector<unsigned int> cell_lines;
    /** What counts these places. */
    std::string place = "line";
    /** Vertices of marked faces in any order. */
    std::vector<std::array<unsigned int, 4>> faces;
    /** Places of the file where faces stand. */
    std::vector<unsigned int> face_lines;
    std::vector<Group>        volumes, surfaces;
    /** Sets of vertices that the file names. */
    std::map<std::string, std::set<unsigned int>> node_sets;

    /** @brief Add a hexahedron of 8, 20 or 27 nodes in the order of Abaqus and VTK: around the
     * bottom, around the top, then the middle of the edges at the bottom, at the top, and
     * between, then of the faces and of the cell.
     * @param line Where the file has it. */
    void
    add_cell(const std::vector<unsigned int> &nodes, unsigned int line);

    /** @brief Add a quadrilateral. @param line Where the file has it. */
    void
    add_face(const std::array<unsigned int, 4> &corners, unsigned int line);

    /** @brief The group with this number, or a new one. */
    static Group &
    group(std::vector<Group> &groups, unsigned int number);

    /** @brief Refuse two cells with the same nodes, which would overlap.
     * @param one_for_each_volume Whether cells of different volumes may be copies, which become
     *   one cell of several volumes: so Gmsh's version 2 writes physical volumes that overlap.
     * @throws MeshFileError that names both lines */
    void
    join_copies(bool one_for_each_volume);

    /** @brief Refuse a quadrilateral that has its corners in common with hexahedra and is the face
     * of none: it would mark nothing. One that touches no hexahedron, or only with an edge, is
     * taken for a part of something else.
     * @throws MeshFileError that names its line */
    void
    check_faces() const;
  };

  /** @brief Read Gmsh .msh, version 2.x or 4.1 in ASCII, or 4.1 in binary.
   * @throws MeshFileError with a sentence that says what is wrong and where. */
  MeshFile
  read_gmsh(std::istream &in);

  /** @brief Read an Abaqus .inp with elements C3D8, C3D20 or C3D27, ELSETs and SURFACEs.
   * @throws MeshFileError */
  MeshFile
  read_abaqus(std::istream &in);

  /** @brief Read a legacy VTK file, ASCII, with an unstructured grid.
   * @param boundary_arrays See read_vtu().
   * @throws MeshFileError */
  MeshFile
  read_vtk(std::istream &in, const std::vector<std::string> &boundary_arrays);

  /** @brief Read an unstructured grid of VTK's XML format.
   * @param boundary_arrays Names of arrays that are not zero in the faces of a boundary, which
   *   gets that name: in quadrilateral cells, or in all corners of a face
   *   (NamedArrays::add_boundaries()).
   * @throws MeshFileError */
  MeshFile
  read_vtu(std::istream &in, const std::vector<std::string> &boundary_arrays);

  /** @brief Add a hexahedron or a face of VTK's @p type with the number of its volume or boundary,
   * or drop what has less dimensions.
   * @param line Where the file has it.
   * @throws MeshFileError for other solids. */
  void
  add_vtk_cell(MeshFile                        &mesh,
               double                           type,
               const std::vector<unsigned int> &nodes,
               unsigned int                     number,
               unsigned int                     line);
} // namespace Touchstone

#endif
