// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_error_estimator_h
#define touchstone_solid_error_estimator_h

#include <touchstone/solid/stress_recovery.h>

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

  /** @brief A displacement with the stress of its cells, and the continuous one recovered from it.
   */
  struct RecoveredStress
  {
    /** With ghosts. */
    Vector        u;
    PointStresses points;
    StressField   field;

    /** @brief Collective. @param u With ghosts. */
    RecoveredStress(StressRecovery &recovery, const Vector &u);
  };

  /**
   * @brief By how much the bilinear form of elasticity of two solutions, a_h(u, z), differs from
   * that of the exact ones in the exact shape of the bodies, a(u, z), by cells: but for the contact
   * conditions (contact_residuals()). Force times length, or force if @p z has no unit.
   *
   * Both errors of the displacements and the shape of the cells enter, doc/theory.md 11, equation
   * (32); the shape is that of the manifolds.
   */
  dealii::Vector<double>
  form_errors(const Solid           &solid,
              const StressRecovery  &recovery,
              const RecoveredStress &u,
              const RecoveredStress &z);
} // namespace Touchstone

#endif
