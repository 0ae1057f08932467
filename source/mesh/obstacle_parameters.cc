// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/expression.h>
#include <touchstone/base/input_error.h>
#include <touchstone/mesh/obstacle_parameters.h>
#include <touchstone/mesh/obstacle_shape.h>

// Keys of a section 'Obstacle NAME': the shape with keys of its own, known as soon as the early
// values give its type, and the rigid translation as a function of time.
namespace Touchstone
{
  using dealii::ParameterHandler;

  std::string
  ObstacleParameters::section() const
  {
    return "Obstacle " + name;
  }



  void
  ObstacleParameters::declare(ParameterHandler &prm, const EarlyValues &values)
  {
    shape.declare_key(prm,
                      values,
                      "Shape",
                      "The rigid surface, which decides on the other keys here.");
    shape.declare_own_keys(prm);
    const std::string motion = " component of the rigid motion, a formula in t (time). [length]";
    prm.add_parameter("Motion x", motion_x, "The x" + motion, FormulaPattern());
    prm.add_parameter("Motion y", motion_y, "The y" + motion, FormulaPattern());
    prm.add_parameter("Motion z", motion_z, "The z" + motion, FormulaPattern());
    prm.add_parameter("Rotate axis",
                      rotate_axis,
                      "Direction of the axis of 'Rotate angle'; its length does not count.");
    prm.add_parameter("Rotate point", rotate_point, "A point of that axis at time 0. [length]");
    prm.add_parameter("Rotate angle",
                      rotate_angle,
                      "The angle by which the obstacle is turned, counter-clockwise for one whom "
                      "the axis points at, a formula in t (time); the motion moves the obstacle "
                      "with its axis. [degrees]",
                      FormulaPattern());
    free.declare(prm);
  }



  void
  ObstacleParameters::check(const std::string &section) const
  {
    shape.check(section);
    check_expression(section, "Motion x", motion_x, "t");
    check_expression(section, "Motion y", motion_y, "t");
    check_expression(section, "Motion z", motion_z, "t");
    check_expression(section, "Rotate angle", rotate_angle, "t");
    if (!(rotate_axis.norm() > 0.))
      throw InputError(section,
                       "Rotate axis",
                       dealii::Patterns::Tools::to_string(rotate_axis),
                       "must not be zero",
                       "give the direction of the axis");
    if (rotate_angle == "0" && rotate_axis != ObstacleParameters().rotate_axis)
      throw InputError(section,
                       "Rotate axis",
                       dealii::Patterns::Tools::to_string(rotate_axis),
                       "means nothing without 'Rotate angle'",
                       "give the angle or remove the axis");
    if (rotate_angle == "0" && rotate_point.norm() > 0.)
      throw InputError(section,
                       "Rotate point",
                       dealii::Patterns::Tools::to_string(rotate_point),
                       "means nothing without 'Rotate angle'",
                       "give the angle or remove the point");
    free.check(section, {{motion_x, motion_y, motion_z, rotate_angle}});
  }
} // namespace Touchstone
