// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_material_point_h
#define touchstone_contact_pairing_material_point_h

#include <touchstone/contact/geometry/face.h>
#include <touchstone/contact/geometry/trace_basis.h>

#include <array>
#include <cstdint>

namespace Touchstone
{
  /** @brief A point of a slave face that moves with the body and has a row between nodes
   * (doc/theory.md 4.2). Its nodes and weights say which point it is: one on an edge belongs to all
   * faces that have the edge. Plain data: it is sent between ranks as it is. */
  struct MaterialPoint
  {
    /** Key of the face on which it was found, and coordinates there. */
    std::uint64_t         face = 0;
    std::array<double, 2> xi{};
    /** The nodes that it moves with, none of which hangs, and their weights. */
    unsigned int                        n = 0;
    std::array<Index, Face::max_nodes>  nodes{};
    std::array<double, Face::max_nodes> weights{};
    /** Which of them has the row. */
    unsigned int slave = 0;
    /** How deep the other surface was within the face when the point was wanted; length. */
    double depth = 0.;

    MaterialPoint() = default;

    /** @param basis Of a face with hanging nodes, or null. */
    MaterialPoint(const Face &of, const TraceBasis *basis, const std::array<double, 2> &at)
      : face(of.key)
      , xi(at)
      , n(basis ? basis->n : of.n_nodes())
      , nodes(basis ? basis->nodes : of.nodes)
    {
      const FaceShapes shapes(of.degree, xi);
      weights = basis ? basis->apply(shapes.value) : shapes.value;
    }
  };
} // namespace Touchstone

#endif
