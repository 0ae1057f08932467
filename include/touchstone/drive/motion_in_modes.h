// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_motion_in_modes_h
#define touchstone_drive_motion_in_modes_h

#include <touchstone/drive/body_motion.h>
#include <touchstone/solid/rigid_body_modes.h>

#include <deal.II/lac/vector.h>

namespace Touchstone
{
  /** @brief How much of each of the rigid motions @p modes, at the present positions of the bodies,
   * comes closest to their motion from the displacement @p start to @p u (owned dofs, length), in
   * the mean of squares over their volume. Collective. */
  dealii::Vector<double>
  motion_in_modes(const Solid      &solid,
                  const FreeMotion &modes,
                  const Vector     &start,
                  const Vector     &u);

  /** @brief The motions of the bodies by these parts of the modes, as rotations about their axes.
   * Collective. */
  Motions
  motions_by_modes(const Solid                  &solid,
                   const FreeMotion             &modes,
                   const dealii::Vector<double> &parts);

  /** @brief The same as a displacement that is linear in the present position, in the state @p u;
   * owned dofs, length. Collective. */
  Vector
  displacement_by_modes(const Solid                  &solid,
                        const FreeMotion             &modes,
                        const dealii::Vector<double> &parts,
                        const Vector                 &u);
} // namespace Touchstone

#endif
