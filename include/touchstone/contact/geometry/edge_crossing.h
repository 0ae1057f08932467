// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_edge_crossing_h
#define touchstone_contact_geometry_edge_crossing_h

#include <touchstone/contact/geometry/face.h>
#include <touchstone/contact/tolerances.h>

#include <optional>
#include <vector>

namespace Touchstone
{
  /** @brief A convex edge of a contact surface in which two faces meet, or in which the
   * surface ends. */
  struct SharpEdge
  {
    dealii::Point<dim> a, b;
    /** The nodes there. */
    std::array<Index, 2> nodes;
    /** The least of its numbers on the faces that meet in it, see Face::edge_key(). */
    std::uint64_t key;
    /** Unit outward normals on both sides of the edge. Where the surface ends, the second
     * points away from it within its tangent plane: the side of the body beyond the edge is
     * unknown and may have any normal between both. */
    std::array<dealii::Tensor<1, dim>, 2> normals;
    /** The faces of these normals, which live as long as the list that the edge was found in; the
     * second is null where the surface ends. */
    std::array<const Face *, 2> faces;
  };

  /** @brief The sharp edges of the faces @p own, in their present positions. Two faces meet in
   * one if their normals differ by more than 30 degrees.
   * @param others Further faces of the surface, which may share edges with them; an edge
   * whose other face is in neither is left out unless Face::outer_edges has it.
   * @param cosine Of the angle between the normals. */
  std::vector<SharpEdge>
  sharp_edges(const std::vector<Face> &own,
              const std::vector<Face> &others,
              double                   cosine = Tolerances::touching_edge_cosine);

  /** @brief The same of a choice of faces of degree 1, also edges that were sharp in the reference
   * state and have been pressed flat. */
  std::vector<SharpEdge>
  sharp_edges(const std::vector<const Face *> &faces,
              double                           cosine = Tolerances::touching_edge_cosine);

  /** @brief The corners of a face at the ends of its edges, as numbers of its nodes, in the order
   * of the bits of Face::outer_edges. */
  std::array<std::array<unsigned int, 2>, 4>
  corners_of_edges(const Face &face);

  /** @brief The plane of symmetry that an edge of a face lies on.
   * @param e The edge, as in the bits of Face::mirrored_edges.
   * @return its unit normal; zero if the edge lies on none, or if the mean normals of its ends,
   *         which lie in the plane as the edge does, are along the edge. */
  dealii::Tensor<1, dim>
  plane_of_symmetry(const Face &face, unsigned int e);

  /** @brief Two edges that can only touch each other. */
  struct EdgeCrossing
  {
    /** The feet of the common perpendicular, on the first and on the second edge. */
    dealii::Point<dim> first, second;
    /** Their distances from the ends a, as fractions of the edges. */
    double along_first, along_second;
    /** Unit vector along the perpendicular, outward from the second edge. */
    dealii::Tensor<1, dim> normal;
    /** Distance of these, length; negative if the edges have not passed through each other. */
    double depth;
  };

  /**
   * @brief Where two edges touch, or have passed through each other: their common perpendicular
   * meets both between their ends and lies between the normals of each.
   *
   * @param slack By how much it may pass their ends, as a fraction of the edge.
   *
   * Where it lies within 15 degrees of one of the normals it is a face that touches, which
   * rows of nodes and faces describe. @param along The cosine of that angle.
   */
  std::optional<EdgeCrossing>
  edge_crossing(const SharpEdge &first,
                const SharpEdge &second,
                double           slack = Tolerances::edge_end,
                double           along = Tolerances::along_normal_cosine);
} // namespace Touchstone

#endif
