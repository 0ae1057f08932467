// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_general_adjusted_surfaces_h
#define touchstone_explicit_general_adjusted_surfaces_h

#include <touchstone/explicit/general/general_contact.h>

#include <map>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Motions of nodes after which surfaces do not overlap, as 'Initial overlap = adjust' of
   * general contact asks for (doc/general_contact.md, section 6).
   *
   * Rows that are closed too far are opened by the shortest motion of their nodes, all at once,
   * each node by the mean of what its rows ask for, again and again: projection on constraints, as
   * Mueller, Heidelberger, Hennix and Ratcliff (2007, J. Vis. Commun. Image Represent. 18, 109-118)
   * do for whole motions. The same on any number of ranks.
   */
  class AdjustedSurfaces
  {
  public:
    /** @brief Of owned nodes of planes of symmetry, which stay in them, by first dof: the normals
     * of the planes. */
    using Planes = std::multimap<Index, dealii::Tensor<1, dim>>;

    /** @brief Find the motions. Collective.
     * @param planes Of all ranks. */
    AdjustedSurfaces(GeneralContact &contact, const NodeMap &nodes, const Planes &planes);

    /** @brief Of all nodes that move, of all ranks, by first dof; length. */
    const std::map<Index, dealii::Tensor<1, dim>> &
    motions() const
    {
      return by_dof;
    }

    /** @brief The largest of them, length. */
    double
    largest() const;

  private:
    std::map<Index, dealii::Tensor<1, dim>> by_dof;

    void
    move(const std::vector<GeneralContact::Overlap> &overlaps, const Planes &planes);
  };
} // namespace Touchstone

#endif
