// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/axes.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Cosine of an angle in degrees that is exactly zero at odd multiples of 90: so vertices of
     * cuts lie exactly in their plane. */
    double
    cosine(const double degrees)
    {
      return std::fmod(std::abs(degrees), 180.) == 90. ? 0.
                                                       : std::cos(degrees * numbers::PI / 180.);
    }
  } // namespace



  Axes::Axes(const std::string &name, const Point<3> &origin)
    : axis(name.at(0) - 'x')
    , origin(origin)
  {
  }



  Tensor<1, 3>
  Axes::direction() const
  {
    Tensor<1, 3> d;
    d[axis] = 1.;
    return d;
  }



  /** The point at @p along on the axis with offsets in the two other directions, in cyclic order
   * (y and z for axis x), so that the coordinates are right-handed whichever axis is chosen. */
  Point<3>
  Axes::point(const double first, const double second, const double along) const
  {
    Point<3> x = origin;
    x[axis] += along;
    x[(axis + 1) % 3] += first;
    x[(axis + 2) % 3] += second;
    return x;
  }



  /** Cylindrical coordinates with the angle in degrees; the sine as the cosine of angle - 90, for
   * the same exact zeros. */
  Point<3>
  Axes::polar(const double radius, const double angle, const double along) const
  {
    return point(radius * cosine(angle), radius * cosine(angle - 90.), along);
  }
} // namespace Touchstone
