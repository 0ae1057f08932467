// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_body_motion_h
#define touchstone_drive_body_motion_h

#include <touchstone/base/types.h>
#include <touchstone/solid/solid.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/physics/transformations.h>

#include <optional>
#include <vector>

namespace Touchstone
{
  /** @brief A rigid motion that is given to a body. */
  struct BodyMotion
  {
    /** Of the centre, length. */
    dealii::Tensor<1, dim> shift;
    /** Rotation vector about the centre, radians. */
    dealii::Tensor<1, dim> turn;
    dealii::Point<dim>     centre;

    /** @brief Whether it is none. */
    bool
    rests() const
    {
      return shift.norm() == 0. && turn.norm() == 0.;
    }

    /** @brief How a point moves that is at @p x before; length. */
    dealii::Tensor<1, dim>
    at(const dealii::Point<dim> &x) const
    {
      const double angle = turn.norm();
      if (angle == 0.)
        return shift;
      const dealii::Tensor<1, dim> distance = x - centre;
      return shift - distance +
             dealii::Physics::Transformations::Rotations::rotation_matrix_3d(turn / angle, angle) *
               distance;
    }
  };

  /** @brief The motions of bodies by their numbers, of those that have a known one. */
  using Motions = std::vector<std::optional<BodyMotion>>;

  /** @brief Add the motions to a displacement @p u. @param start Displacement from which they
   * start. Both over the owned dofs; length. */
  void
  move_bodies(const Solid &solid, const Motions &motions, const Vector &start, Vector &u);
} // namespace Touchstone

#endif
