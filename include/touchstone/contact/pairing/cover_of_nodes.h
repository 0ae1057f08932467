// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_cover_of_nodes_h
#define touchstone_contact_pairing_cover_of_nodes_h

#include <touchstone/contact/geometry/surface.h>
#include <touchstone/contact/pairing/dual_basis.h>
#include <touchstone/contact/pairing/overlap_integrals.h>
#include <touchstone/contact/search/facing_faces.h>

#include <deal.II/base/tensor.h>

#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Which part of the surface around each node a pair covers, as vector areas: sums of
   * -int N~_k zeta over slave faces, zeta their outward normals (doc/theory.md 3.1, "Faces that
   * several pairs cover").
   *
   * These are the nodal forces of a unit pressure, so that areas of one surface add up over all
   * pairs, whether it is their slave or their master; those of other surfaces at an edge of a body
   * are across to it.
   */
  struct CoverOfNodes
  {
    using Areas = std::unordered_map<Index, dealii::Tensor<1, dim>>;

    /** What is covered, by surfaces that are not apart: by slave nodes of this rank and master
     * nodes of any rank. */
    Areas covered;
    /** Of slave nodes of this rank: what is covered, closed or open, and all of the slave
     * surface. */
    Areas own, whole;
    /** Slave nodes of this rank that are to leave their rows to others (Face::without_row), but in
     * the committed state touch on a face whose other nodes cannot take it: they keep all that they
     * have (doc/theory.md 3.1, "Edges where pairs meet"). */
    std::unordered_set<Index> keep_rows;

    /** @brief Forget the areas. */
    void
    clear()
    {
      for (Areas *areas : {&covered, &own, &whole})
        areas->clear();
    }

    /** @brief Add function @p k of a slave face to the whole surface around @p node.
     * @param basis Of a face with hanging nodes, or null. */
    void
    add_whole(Index node, unsigned int k, const Face &slave, const TraceBasis *basis);

    /** @brief Add what is covered of function @p k of a slave face.
     * @param node  To which the function belongs; owned by this rank.
     * @param plane plane_normal() of the face. @param dual Of what is covered.
     * @param parts What each of the masters covers. */
    template <unsigned int n>
    void
    add(const SurfaceNode                              &node,
        unsigned int                                    k,
        const dealii::Tensor<1, dim>                   &plane,
        const DualBasis                                &dual,
        const std::vector<FacingFace>                  &masters,
        const std::vector<OverlapIntegrals<n, double>> &parts);
  };
} // namespace Touchstone

#endif
