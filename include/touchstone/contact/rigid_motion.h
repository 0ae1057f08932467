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
} // namespace Touchstone

#endif
