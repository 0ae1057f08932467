// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_mesh_copies_h
#define touchstone_mesh_mesh_copies_h

#include <touchstone/mesh/affine_map.h>
#include <touchstone/mesh/geometry.h>

namespace Touchstone
{
  /** @brief Take the body to another place. Cells that the map turns inside out are numbered anew.
   * @param with_surfaces Exact surfaces go along, see mapped_surface(). */
  void
  move_mesh(const AffineMap &map, bool with_surfaces, BodyMesh &mesh);

  /** @brief Add a copy of @p original, mapped, to @p mesh, without any common vertices. Its
   * boundaries count as those of the original. */
  void
  append_copy(const BodyMesh &original, const AffineMap &map, BodyMesh &mesh);

  /** @brief Whether boundary vertices of different copies are in one place.
   * @param of_each   Vertices of each copy, which follow one another.
   * @param tolerance Length. */
  bool
  vertices_coincide(const BodyMesh &mesh, std::size_t of_each, double tolerance);
} // namespace Touchstone

#endif
