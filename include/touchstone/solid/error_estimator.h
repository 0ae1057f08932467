// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_error_estimator_h
#define touchstone_solid_error_estimator_h

#include <touchstone/solid/solid.h>

#include <deal.II/lac/vector.h>

namespace Touchstone
{
  /**
   * @brief Squared error of the stress in the energy norm by cells, from the jumps of
   * the displacement gradient between cells; force times length, in the order of
   * active cell indices, zero for cells of other ranks.
   *
   * Kelly, De S. R. Gago, Zienkiewicz and Babuska (1983), Int. J. Numer. Meth. Engng
   * 19; eta^2 = E h/24 int |[du/dn]|^2. Jumps to other bodies do not count.
   * @param u With ghosts.
   */
  dealii::Vector<double>
  jump_errors(const Solid &solid, const Vector &u);

  /**
   * @brief The same from the distance between the stress of the cells and the
   * continuous one that its averages at the nodes make.
   *
   * Zienkiewicz and Zhu (1987), Int. J. Numer. Meth. Engng 24. Bodies share no nodes,
   * so that nothing is averaged over a contact.
   */
  dealii::Vector<double>
  recovery_errors(const Solid &solid, const Vector &u);

  /**
   * @brief Estimate of the products of the errors of two displacements in the bilinear form of
   * elasticity, a(e_u, e_z), by cells: the same distances of stress multiplied with each other.
   * Force times length, or force if @p z has no unit.
   * @param u, z With ghosts.
   */
  dealii::Vector<double>
  recovery_products(const Solid &solid, const Vector &u, const Vector &z);
} // namespace Touchstone

#endif
