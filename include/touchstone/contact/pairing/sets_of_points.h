// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_sets_of_points_h
#define touchstone_contact_pairing_sets_of_points_h

#include <touchstone/contact/pairing/material_point.h>

#include <array>
#include <optional>
#include <vector>

// Which of the points that overlaps suggest are to have rows (doc/theory.md 4.2).
namespace Touchstone
{
  /** @brief Nearer to each other than this, see distance(), two points are one. */
  constexpr double same_place = 1e-3;

  /** @brief Whether the row of a point refers to a node. */
  bool
  refers_to(const MaterialPoint &point, Index node);

  /** @brief Where a point is on a face that has all nodes that it refers to, if this one has. */
  std::optional<std::array<double, 2>>
  coordinates_on(const Face &face, const MaterialPoint &point);

  /** @brief The one that has the row of a node, or null. */
  const MaterialPoint *
  point_of(const std::vector<MaterialPoint> &points, Index node);

  /** @brief How far two points are from each other: the sum of the differences of their weights,
   * which is that of coordinates where two of a face differ in one. A point is its nodes and
   * weights: on an edge it is the same in each of the faces. */
  double
  distance(const MaterialPoint &one, const MaterialPoint &other);

  /** @brief Whether two points are one, perhaps of two faces on the edge between them. */
  bool
  coincide(const MaterialPoint &one, const MaterialPoint &other);

  /** @brief Whether some face has both points, within it or on its edges. */
  bool
  in_same_face(const MaterialPoint &one, const MaterialPoint &other);

  /** @brief Whether a point is where another one was in the last step, or near it, and takes over
   * its history. */
  bool
  goes_on_from(const MaterialPoint &last, const MaterialPoint &point);

  /** @brief Two points in faces that share a node and are about equally deep: round-off, or the
   * numbers of the nodes, would choose one of them, and the result would be less symmetric than
   * the scene. */
  bool
  equally_deep(const MaterialPoint &one, const MaterialPoint &other);

  /** @brief Two points beside the edge between their faces, each as near to it as the other, are
   * one on the edge. @param wanted The deepest first. */
  std::vector<MaterialPoint>
  on_edges(std::vector<MaterialPoint> wanted);

  /** @brief Of points in faces that share a node the deepest, and those that are equally_deep():
   * with rows there the other faces may touch nothing. @param wanted The deepest first. */
  std::vector<MaterialPoint>
  deepest_of_neighbours(const std::vector<MaterialPoint> &wanted);

  /** @brief Whether rows refer to each other's slave nodes in a cycle: an iterative solver, which
   * eliminates them, could not do so. */
  bool
  in_cycle(std::vector<MaterialPoint> points);
} // namespace Touchstone

#endif
