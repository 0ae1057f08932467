// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_search_slave_point_h
#define touchstone_contact_search_slave_point_h

#include <touchstone/base/types.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace Touchstone
{
  class SelfContact;

  /** @brief A slave node for which a partner is searched. */
  struct SlavePoint
  {
    /** Present position, and at the start of the step. */
    dealii::Point<dim> x, start;
    /** Outward normal of the slave surface there: faces whose normals are about the same
     * are on the far side of a body. */
    dealii::Tensor<1, dim> normal;
    /** The node carried a contact force before. */
    bool in_contact = false;
    /** Key of the face that the node had last: one in contact may keep it, and the search begins
     * there. */
    std::optional<std::uint64_t> present_face;
    /** The index that this face had in FaceExchange::faces() then; any other only costs time. */
    std::size_t index_before = std::numeric_limits<std::size_t>::max();

    /** The node leaves the end of the surface only at a multiple of the distance beyond it up to
     * which others find a partner, see EndOfSurface. */
    bool stays_at_end = in_contact;

    /** Of a node at no sharp edge of the slave surface. Near a face that it faces it meets none
     * that is seen edge-on: to it the master ends at an edge over which there are none but such
     * faces. */
    bool is_plain = false;

    /** @name Where slave and master are the same body; null elsewhere */
    /** @{ */
    const SelfContact *self = nullptr;
    /** The node, in its reference position, the normals there of the faces around it in the
     * reference state, and whether it is a master node, too. */
    Index                               node = invalid_index;
    dealii::Point<dim>                  reference{};
    std::vector<dealii::Tensor<1, dim>> made_normals{};
    bool                                also_master = false;
    /** @} */
  };
} // namespace Touchstone

#endif
