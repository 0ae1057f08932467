// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_overlap_derivative_h
#define touchstone_contact_pairing_overlap_derivative_h

#include <touchstone/contact/pairing/overlap_integrals.h>

namespace Touchstone
{
  /**
   * @brief OverlapIntegrals of one master face with all their derivatives: those with respect to
   * the positions of the nodes of both faces come with the numbers, those with respect to the
   * averaged normals of these nodes beside them, to be continued to the nodes that the normals
   * depend on.
   */
  template <unsigned int n>
  struct OverlapDerivative : OverlapIntegrals<n, PositionFad<n>>
  {
    const Face *master;
    /** The master surface is a smooth patch, so that its points depend on nodal normals. */
    bool master_smooth;

    /** [j][m]: of the integral of N_j times the normal by the normal at master node m, area; of
     * that of N_j times the gap by the same and by the normal at slave node m, area times
     * length. */
    dealii::Tensor<2, dim> normal_normal[n][n], gap_normal[n][n], gap_slave_normal[n][n];
    /** The same of the integral of N_j times the arch by the normal at slave node m. */
    dealii::Tensor<1, dim> arch_slave_normal[n][n];

    /** Of a smallest gap by the normals at master and slave nodes, length. */
    struct ByNormals
    {
      dealii::Tensor<1, dim> master[n], slave[n];
    };
    ByNormals least_by_normals, own_by_normals[n];

    /** @param length Of the OverlapIntegrals. */
    OverlapDerivative(const double length, const FaceGeometry &master)
      : OverlapIntegrals<n, PositionFad<n>>(length)
      , master(&master.face())
      , master_smooth(master.smooth())
    {
    }

    /** @brief Add a quadrature point. @param on_master Of the master face. */
    void
    add(const OverlapPointDerivative<n> &point,
        const FaceDifferentiator        &on_slave,
        const FaceDifferentiator        &on_master);
  };
} // namespace Touchstone

#endif
