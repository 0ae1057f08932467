// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_unnamed_nodes_h
#define touchstone_contact_unnamed_nodes_h

#include <touchstone/contact/contact.h>

#include <deal.II/base/types.h>

#include <set>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief Boundaries with the bodies that they belong to. */
  using NamedBoundaries = std::set<std::pair<unsigned int, dealii::types::boundary_id>>;

  /** @brief A node of the surface of a body that lies on no boundary of a choice. */
  struct UnnamedNode
  {
    unsigned int body;
    /** First degree of freedom. */
    Index node;
    /** Position now and in the reference state, without displacement. */
    dealii::Point<dim> now, start;
    /** Size of its cell, length. */
    double size;
  };

  /**
   * @brief The vertices of the surfaces of all bodies, in cells of this rank, that lie on none of
   * the boundaries @p named.
   *
   * Rows know nothing of them, so that they may come to lie within what other boundaries of their
   * body touch (doc/theory.md 4.1). In contrast to centres of faces they are points of the bodies
   * and not of facets. Vertices on planes of symmetry are left out.
   * @param u Displacement with ghosts.
   */
  std::vector<UnnamedNode>
  unnamed_nodes(const Contact &contact, const NamedBoundaries &named, const Vector &u);
} // namespace Touchstone

#endif
