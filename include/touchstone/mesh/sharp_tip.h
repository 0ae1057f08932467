// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_sharp_tip_h
#define touchstone_mesh_sharp_tip_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

namespace Touchstone
{
  /** @brief A surface that ends in a point on an axis. Points on the axis are pushed along it by
   * the tip; beside it they slide down the side, however close they are. */
  class SharpTip
  {
  public:
    virtual ~SharpTip() = default;

    /** @brief Whether the tip is sharp, and @p x is closer to its axis than @p tolerance; length.
     */
    virtual bool
    is_before_tip(const dealii::Point<3> &x, double tolerance) const = 0;

    virtual dealii::Point<3>
    tip() const = 0;

    /** @brief Unit normal of the surface for points on the axis. */
    virtual dealii::Tensor<1, 3>
    normal_at_tip() const = 0;
  };
} // namespace Touchstone

#endif
