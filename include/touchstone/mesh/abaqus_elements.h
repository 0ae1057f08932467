// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_abaqus_elements_h
#define touchstone_mesh_abaqus_elements_h

#include <string>

namespace Touchstone
{
  /** @brief What is read of an Abaqus element: a hexahedron, a quadrilateral, or nothing (beams,
   * springs and the like). */
  struct AbaqusElement
  {
    /** @param type Value of TYPE, in capitals.
     * @throws MeshFileError for solids of another shape, without which the body would have
     * holes, and elements without a type. */
    explicit AbaqusElement(const std::string &type);

    /** Nodes of a hexahedron or of a quadrilateral; the other one is zero. */
    unsigned int of_cell, of_face;

    /** Whether it is a triangle, which MeshFile refuses. */
    bool triangular;
  };
} // namespace Touchstone

#endif
