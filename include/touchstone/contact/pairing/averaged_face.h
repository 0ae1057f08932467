// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_averaged_face_h
#define touchstone_contact_pairing_averaged_face_h

#include <touchstone/contact/geometry/surface.h>
#include <touchstone/contact/pairing/partial_cover.h>

#include <array>
#include <unordered_map>
#include <vector>

namespace Touchstone
{
  /** @brief A slave face of averaged pairing: to which rows its nodes belong, and how they share
   * what is covered of it (CoverShares). */
  struct AveragedFace
  {
    const Face *face;
    /** The basis of the continuous displacements, if the face has hanging nodes; or null. */
    const TraceBasis *basis;
    /** The rows of its nodes; negative: of another rank. */
    std::array<int, Face::max_nodes> row;
    /** whole_areas() in the reference state. */
    std::array<double, Face::max_nodes> whole;
    /** Of CoverShares. */
    CoverShares::Whole at_once;
    /** CoverShares::cover of the last update; negative: not covered. */
    std::array<double, Face::max_nodes> cover;

    /**
     * @param face, basis As the members; must live as long.
     * @param row_of_node The rows of the nodes of this rank.
     * @param tied Rows of tied pairs are made once, so they need not depend smoothly on the cover.
     */
    AveragedFace(const Face                           &face,
                 const TraceBasis                     *basis,
                 const std::unordered_map<Index, int> &row_of_node,
                 bool                                  tied);

    /** @brief Whether any node has a row of this rank. */
    bool
    has_rows() const;

    /** @brief The committed state is that of the last update: which nodes kept their parts. */
    void
    commit();

    /** @brief How far other pairs cover the rest around the nodes, see
     * Pairing::set_cover_by_others(). @return Whether anything has changed. */
    bool
    set_cover_by_others(const Vector *part);
  };

  /** @brief The slave faces around the nodes of this rank, of owned and of ghost cells, in the
   * order of their keys: with all faces around an owned node the sums over them are complete
   * without another rank. Parameters are those of AveragedFace. */
  std::vector<AveragedFace>
  averaged_faces(const Surface                        &slave,
                 const std::unordered_map<Index, int> &row_of_node,
                 bool                                  tied);
} // namespace Touchstone

#endif
