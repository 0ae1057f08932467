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
  }



  void
  ObstacleParameters::check(const std::string &section) const
  {
    shape.check(section);
    check_expression(section, "Motion x", motion_x, "t");
    check_expression(section, "Motion y", motion_y, "t");
    check_expression(section, "Motion z", motion_z, "t");
  }
} // namespace Touchstone
