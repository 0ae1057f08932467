#include <touchstone/base/expression.h>
#include <touchstone/base/input_error.h>
#include <touchstone/mesh/obstacle_parameters.h>

namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  std::string
  ObstacleParameters::section() const
  {
    return "Obstacle " + name;
  }



  void
  ObstacleParameters::declare(ParameterHandler &prm)
  {
    prm.add_parameter("Shape",
                      shape,
                      "The rigid surface: a 'plane', 'sphere' or 'cylinder'.",
                      Patterns::Selection("plane|sphere|cylinder"));
    prm.add_parameter("Point",
                      point,
                      "A point of the plane, the centre of the sphere, or a point "
                      "of the cylinder's axis: x, y, z. [length]");
    prm.add_parameter("Direction",
                      direction,
                      "The plane's normal, pointing to where the bodies are, or "
                      "the direction of the cylinder's axis: x, y, z; its length "
                      "does not count.");
    prm.add_parameter("Radius",
                      radius,
                      "Radius of the sphere or cylinder, greater than zero. "
                      "[length]",
                      Patterns::Double());
    prm.add_parameter("Side",
                      side,
                      "The bodies are 'outside' or 'inside' of the sphere or "
                      "cylinder.",
                      Patterns::Selection("outside|inside"));
    const std::string motion = " component of the rigid motion, a formula in t (time). [length]";
    prm.add_parameter("Motion x", motion_x, "The x" + motion, Patterns::Anything());
    prm.add_parameter("Motion y", motion_y, "The y" + motion, Patterns::Anything());
    prm.add_parameter("Motion z", motion_z, "The z" + motion, Patterns::Anything());
  }



  void
  ObstacleParameters::check(const std::string &section) const
  {
    if (shape != "sphere" && direction.norm() == 0.)
      throw InputError(section,
                       "Direction",
                       Patterns::Tools::to_string(direction),
                       "must not be zero",
                       "give the normal of the plane or the axis of the cylinder");
    if (shape != "plane" && radius <= 0.)
      throw InputError(section,
                       "Radius",
                       Patterns::Tools::to_string(radius),
                       "must be positive",
                       "give the radius of the " + shape);
    check_expression(section, "Motion x", motion_x, "t");
    check_expression(section, "Motion y", motion_y, "t");
    check_expression(section, "Motion z", motion_z, "t");
  }
} // namespace Touchstone
