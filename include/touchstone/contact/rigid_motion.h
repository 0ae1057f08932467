// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_rigid_motion_h
#define touchstone_contact_rigid_motion_h

#include <touchstone/base/types.h>

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

namespace Touchstone
{
  /** @brief Where a rigid obstacle is: its point X of the input is at turn X + shift. */
  struct RigidMotion
  {
    dealii::Tensor<2, dim> turn =
      static_cast<dealii::Tensor<2, dim>>(dealii::unit_symmetric_tensor<dim>());
    /** Displacement of the origin, length. */
    dealii::Tensor<1, dim> shift;
    /** Whether it turns at all: without, not even round-off comes from the rotation. */
    bool turned = false;

    /** @brief A direction of the obstacle in space. */
    dealii::Tensor<1, dim>
    direction(const dealii::Tensor<1, dim> &of_obstacle) const
    {
      return turned ? turn * of_obstacle : of_obstacle;
    }

    /** @brief Where a point of the obstacle is. */
    dealii::Point<dim>
    place(const dealii::Point<dim> &of_obstacle) const
    {
      return dealii::Point<dim>(direction(of_obstacle) + shift);
    }

    /** @brief The point of the obstacle, or fixed to it, that is at @p x. */
    dealii::Point<dim>
    back(const dealii::Point<dim> &x) const
    {
      const dealii::Point<dim> moved = x - shift;
      return turned ? dealii::Point<dim>(moved * turn) : moved;
    }

    /** @brief How far the point that is at @p x now has moved since @p earlier. */
    dealii::Tensor<1, dim>
    since(const RigidMotion &earlier, const dealii::Point<dim> &x) const
    {
      if (!turned && !earlier.turned)
        return shift - earlier.shift;
      return x - earlier.place(back(x));
    }
  };

  /** @brief How far forces have moved an obstacle from where it is driven: a turn about a point of
   * it, and a displacement of that point. */
  struct ToolMotion
  {
    /** The point at time 0. */
    dealii::Point<dim>     point;
    dealii::Tensor<1, dim> shift;
    dealii::Tensor<2, dim> turn = RigidMotion().turn;
    /** Whether it may turn at all. */
    bool turns = false;

    /** @brief Where the obstacle is that is driven to @p driven. */
    RigidMotion
    after(const RigidMotion &driven) const
    {
      RigidMotion result = driven;
      result.shift += shift;
      if (turns)
        {
          const dealii::Point<dim> centre = driven.place(point);
          result.turned                   = true;
          result.turn                     = turn * driven.turn;
          result.shift += turn * (driven.shift - centre) - (driven.shift - centre);
        }
      return result;
    }
  };

  /** @brief What has come of an obstacle that is moved by forces. */
  struct RigidToolResult
  {
    /** Of its reference point, length; and its turn about axes, degrees. */
    dealii::Tensor<1, dim> displacement, rotation;
    /** Of the bodies on it, moment about the reference point. */
    dealii::Tensor<1, dim> force, moment;
    /** In dynamics: of the reference point, and angular velocity in radians per time. */
    dealii::Tensor<1, dim> velocity, angular_velocity;
    bool                   dynamic = false;
  };
} // namespace Touchstone

#endif
