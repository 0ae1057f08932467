// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_trace_basis_h
#define touchstone_contact_geometry_trace_basis_h

#include <touchstone/algebra/stencil.h>
#include <touchstone/contact/geometry/face.h>
#include <touchstone/solid/solid.h>

namespace Touchstone
{
  /**
   * @brief The basis that a face with hanging nodes takes from the continuous
   * displacements: N~_p = sum_i C_ip N_i.
   *
   * A node that hangs on the edge of a larger face follows the nodes of that edge,
   * u_h = sum_p C_hp u_p. One of these is not a node of the face itself and takes
   * the role of the hanging one, so that the basis has as many functions as the
   * face has nodes. Plain data: it is sent between ranks as it is.
   */
  struct TraceBasis
  {
    unsigned int n = 0;
    /** The nodes p, of which none hangs. */
    std::array<Index, Face::max_nodes> nodes{};
    /** C_ip: [node i of the face][p], no unit. */
    std::array<std::array<double, Face::max_nodes>, Face::max_nodes> weights{};

    /** @param hanging Of the displacement. */
    TraceBasis(const Face &face, const dealii::AffineConstraints<double> &hanging);
    TraceBasis() = default;

    /** @brief From integrals with N_i, or values of it, to those with N~_p. */
    std::array<double, Face::max_nodes>
    apply(const std::array<double, Face::max_nodes> &values) const;

    /** @brief What node @p i of the face follows; itself if it does not hang. */
    Stencil
    stencil(unsigned int i) const;

    /** @brief Whether any node of the face hangs. */
    static bool
    needed(const Face &face, const dealii::AffineConstraints<double> &hanging);
  };
} // namespace Touchstone

#endif
