// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_stable_step_h
#define touchstone_explicit_stable_step_h

#include <touchstone/explicit/cell_forces.h>
#include <touchstone/explicit/hexahedron.h>

namespace Touchstone
{
  /** @brief Derivative of the volume of a hexahedron by the positions of its nodes, exact;
   * the product with the volume of the mean gradients of Flanagan and Belytschko (1981). */
  std::array<dealii::Tensor<1, dim>, Hexahedron::n_nodes>
  volume_derivative(const Hexahedron::Corners &x);

  /**
   * @brief The squared largest frequency of a cell with one point of integration, exact for
   * isotropic elasticity and any masses of the nodes.
   *
   * With b_a the mean gradients, G = sum_a b_a b_a^T / m_a and s_i the roots of the eigenvalues g_i
   * of G it is V times the largest eigenvalue of lambda s s^T + 2 mu diag(g). See doc/explicit.md,
   * section 4.
   * @param G         Of the derivatives of the volume in place of the mean gradients, which are
   *                  these over the volume.
   * @return 0 if the volume is not positive.
   */
  double
  one_point_frequency(const dealii::SymmetricTensor<2, dim> &G,
                      double                                 volume,
                      const MaterialParameters              &material);

  /** @brief The same of a cell with these corners. */
  double
  one_point_frequency(const Hexahedron::Corners     &x,
                      const MaterialParameters      &material,
                      const CellForces::NodalMasses &masses);
} // namespace Touchstone

#endif
