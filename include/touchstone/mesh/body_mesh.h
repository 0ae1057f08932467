// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_body_mesh_h
#define touchstone_mesh_body_mesh_h

#include <touchstone/mesh/geometry.h>

#include <deal.II/grid/tria.h>

#include <array>
#include <functional>
#include <stdexcept>

/**
 * @file
 * Functions that geometries share for making meshes.
 */

namespace Touchstone
{
  /** @brief A mesh that neither the machine's memory nor the numbers of its unknowns could
   * hold. The message is a sentence. */
  class TooManyCells : public std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /** @brief Call before a mesh of @p n cells is made.
   * @throws TooManyCells */
  void
  check_number_of_cells(double n);

  /** @brief Number of cells @p n times @p factor, rounded, at least one.
   * @throws TooManyCells */
  unsigned int
  scaled_cells(unsigned int n, double factor);

  /**
   * @brief The @p n + 1 positions from @p lower to @p upper whose intervals form
   * a geometric sequence.
   * @param ratio Length of the last interval over that of the first.
   */
  std::vector<double>
  graded_positions(double lower, double upper, unsigned int n, double ratio);

  /**
   * @brief A block of cells in rows, columns and layers.
   *
   * @param n        Cells in each of the three directions, which must form a
   *                 right-handed system.
   * @param closed   The second direction closes to a ring.
   * @param position Position of vertex i, j, k.
   * @param ids      Boundary ids of the lower and upper side of each direction.
   */
  BodyMesh
  make_block(
    const std::array<unsigned int, 3>                                               &n,
    bool                                                                             closed,
    const std::function<dealii::Point<3>(unsigned int, unsigned int, unsigned int)> &position,
    const std::array<dealii::types::boundary_id, 6>                                 &ids);

  /** @brief Vertices of a face. */
  using FaceVertices = std::array<unsigned int, 4>;

  /** @brief Those of face @p f of a hexahedron, in deal.II's order. @param cell Its corners first.
   */
  FaceVertices
  face_of_cell(const std::vector<unsigned int> &cell, unsigned int f);

  /** @brief The same in ascending order, in which two cells have a common face alike. */
  FaceVertices
  sorted_face(const std::vector<unsigned int> &cell, unsigned int f);

  /**
   * @brief The faces that belong to one cell only.
   * @throws std::runtime_error if a face belongs to more than two cells.
   */
  std::vector<FaceVertices>
  boundary_faces(const std::vector<dealii::CellData<3>> &cells);

  /**
   * @brief Append the boundary faces to mesh.subcells.
   * @param classify Boundary id and manifold id of the face with these vertices.
   */
  void
  add_boundary_faces(
    BodyMesh                 &mesh,
    const std::function<std::pair<dealii::types::boundary_id, dealii::types::manifold_id>(
      const FaceVertices &)> &classify);

  /** @brief Cells by the sign of the Jacobian determinant at their corners. */
  struct Orientation
  {
    /** Negative at all corners: numbered the wrong way round, or folded over. */
    unsigned int negative = 0;
    /** Zero somewhere, or of changing sign: distorted. */
    unsigned int distorted = 0;
  };

  /** @brief Count the cells that are not positive at each corner. */
  Orientation
  orientation(const BodyMesh &mesh);

  /** @brief Give @p triangulation the mesh with its boundary ids and manifolds,
   * which it also passes on to the edges. */
  void
  create_triangulation(const BodyMesh &mesh, dealii::Triangulation<3> &triangulation);
} // namespace Touchstone

#endif
