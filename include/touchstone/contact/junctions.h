// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_junctions_h
#define touchstone_contact_junctions_h

#include <touchstone/contact/contact_pair.h>

#include <memory>
#include <set>
#include <vector>

namespace Touchstone
{
  /** @brief Rows of pairs on this rank, by pair. */
  using RowsByPair = std::vector<std::vector<ContactRow>>;

  /** @brief The nodes that belong to surfaces of two or more pairs, the same on all ranks.
   * Collective. */
  std::set<Index>
  nodes_of_several_pairs(const std::vector<std::unique_ptr<ContactPair>> &pairs,
                         const Solid                                     &solid);

  /** @brief Whether rows of a pair can determine all displacements of their nodes: it is tied or
   * has friction. */
  bool
  can_stick(const ContactPair &pair);

  /**
   * @brief Slave nodes of pairs that are tied or have friction where the nodes that they face are
   * joined to them by other pairs, too: at an edge around which three or more bodies lie, or two
   * bodies that meet in several pairs (doc/theory.md 3.1, "Edges where pairs meet").
   *
   * Displacements that all of these pairs determine there are determined more than once; rows of
   * all pairs, and multipliers of all, are dependent, or nearly so. The multiplier space of
   * mortar methods has no function of its own at such points: Bernardi, Maday and Patera
   * (1994); Puso (2004), Int. J. Numer. Methods Engng 59.
   *
   * @param rows  Of all slave nodes, as if none left its row to others.
   * @param nodes nodes_of_several_pairs().
   * @return By pair; the same on all ranks. Collective.
   */
  std::vector<std::set<Index>>
  junction_nodes(const std::vector<std::unique_ptr<ContactPair>> &pairs,
                 const RowsByPair                                &rows,
                 const std::set<Index>                           &nodes,
                 const Solid                                     &solid);

  /**
   * @brief Slave nodes that supports hold along the normal of their row, as they hold what the
   * nodes face (doc/theory.md 3.1, "Edges that supports hold"): at the end of an interface both
   * sides of which have prescribed displacements. No displacement is left for a row there to
   * determine, and the multiplier space of mortar methods has no function of its own at such
   * points, either.
   *
   * @param rows     Of all slave nodes, as if none left its row to others.
   * @param supports Directions in which displacements of owned nodes are prescribed; planes of
   *                 symmetry of the pair hold nodes as the mirrored half of the body would.
   * @return By pair; the same on all ranks. Collective.
   */
  std::vector<std::set<Index>>
  held_nodes(const std::vector<std::unique_ptr<ContactPair>> &pairs,
             const RowsByPair                                &rows,
             const ContactPair::Mirrors                      &supports,
             const Solid                                     &solid);

  /**
   * @brief Slave nodes with rows of several pairs on the same side that are tied or have friction,
   * by the pairs whose rows they leave to others: all but the one that covers most of the node, all
   * if two cover about the same (doc/theory.md 3.1, "Slave nodes over joints"). At a slave face
   * over the joint of two masters both rows would determine all displacements of the node, and one
   * of them those of the masters, which may have too few nodes there.
   *
   * @param rows Of all slave nodes, as if none left its row to others.
   * @return By pair; the same on all ranks. Collective.
   */
  std::vector<std::set<Index>>
  nodes_over_joints(const std::vector<std::unique_ptr<ContactPair>> &pairs,
                    const RowsByPair                                &rows,
                    const Solid                                     &solid);
} // namespace Touchstone

#endif
