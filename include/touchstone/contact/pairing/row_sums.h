// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_row_sums_h
#define touchstone_contact_pairing_row_sums_h

#include <touchstone/algebra/stencil.h>
#include <touchstone/contact/pairing/averaged_row.h>
#include <touchstone/contact/pairing/dual_basis.h>
#include <touchstone/contact/pairing/overlap_integrals.h>

namespace Touchstone
{
  /** @brief The sums over the slave faces around a node from which its complete row is made. */
  struct RowSums : CoverSums
  {
    /** Integral of the slave position less that of the node, area times length. */
    dealii::Tensor<1, dim> lever;
    /** W: integrals of master shapes with psi'_k, less the areas that other nodes give to this
     * row. One or two dozen nodes; in ascending order after finish(). */
    Stencil stencil;
    /** Areas received from other slave nodes, and areas given to them. */
    Stencil taken, left;

    /** @brief Set to zero; the lists keep their capacity. */
    void
    clear();

    /** @brief Add what row @p k takes of what one master face covers.
     * @param face The entry of the slave face in `faces`, or null where the node of the row does
     * not belong to the face. */
    template <unsigned int n>
    void
    add(unsigned int                       k,
        const DualBasis                   &dual,
        const Face                        &master,
        const OverlapIntegrals<n, double> &part,
        FaceShare                         *face);

    /** @brief All faces have been added: the stencil gets what is taken from other nodes. */
    void
    finish();

    /** @brief Add to the weight of a node. */
    static void
    add(Stencil &list, Index node, double value);
  };
} // namespace Touchstone

#endif
