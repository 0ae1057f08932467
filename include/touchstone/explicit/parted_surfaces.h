// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_parted_surfaces_h
#define touchstone_explicit_parted_surfaces_h

#include <touchstone/contact/contact.h>
#include <touchstone/explicit/node_map.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief Bounds from below how far the two sides of contact pairs are apart, by planes between
   * them: as long as there is one no row is needed (doc/explicit.md, section 9.5).
   *
   * Of each pair the extents of both surfaces along 13 directions are compared, those of a cube's
   * faces, edges and corners: discrete oriented polytopes (Klosowski et al. 1998, IEEE Trans.
   * Visual. Comput. Graphics 4).
   */
  class PartedSurfaces
  {
  public:
    PartedSurfaces(const Contact &contact, const NodeMap &nodes);

    /** @brief Choose the plane of each pair. The rows of the contact must be those of the present
     * state. Collective. @param u Displacement, ghosts as well.
     * @return Smallest gap that a row of any pair can have, length; not positive if there is none
     * of a pair, or the pair must always be looked at. */
    double
    part(const NodeField &u);

    /** @brief The same with the planes chosen. Collective. */
    double
    gap(const NodeField &u) const;

  private:
    const Contact &contact;
    const NodeMap &nodes;
    /** There are pairs, and each is of two bodies whose rows are between nodes and facets. */
    bool possible = false;
    /** Local nodes of the surfaces of a pair. */
    struct Sides
    {
      std::vector<unsigned int> slave, master;
      /** From the master to the slave side. */
      dealii::Tensor<1, dim> normal;
      /** Sum of the absolute negative weights of any row: points that rows face lie so far
       * outside of their faces. */
      double outside = 0.;
    };
    std::vector<Sides> pairs;

    /** Smallest gap of a pair along some directions: all sides, and the extent of the master. */
    std::vector<double>
    extents(const NodeField                           &u,
            const std::vector<unsigned int>           &list,
            const std::vector<dealii::Tensor<1, dim>> &directions) const;
    static double
    gap_of(const Sides &pair, double least_slave, double most_master, double least_master);
  };
} // namespace Touchstone

#endif
