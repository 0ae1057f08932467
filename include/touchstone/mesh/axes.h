// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_axes_h
#define touchstone_mesh_axes_h

#include <deal.II/base/point.h>

#include <string>

namespace Touchstone
{
  /**
   * @brief A right-handed system with its third direction along x, y or z.
   *
   * Angles count from the first direction to the second, which follow in the
   * order x, y, z, x, y: from y to z for axis x, z to x for y, x to y for z.
   */
  class Axes
  {
  public:
    /** @param name "x", "y" or "z". @param origin Point of the axis. */
    Axes(const std::string &name, const dealii::Point<3> &origin);

    /** @brief The direction of the axis. */
    dealii::Tensor<1, 3>
    direction() const;

    /** @brief The point with these coordinates in the system. */
    dealii::Point<3>
    point(double first, double second, double along) const;

    /** @brief The same in cylindrical coordinates; the angle in degrees. Exactly
     * on the coordinate planes for multiples of 90 degrees. */
    dealii::Point<3>
    polar(double radius, double angle, double along) const;

  private:
    const unsigned int     axis;
    const dealii::Point<3> origin;
  };
} // namespace Touchstone

#endif
