#include <touchstone/base/expression.h>
#include <touchstone/base/input_error.h>
#include <touchstone/base/suggestion.h>
#include <touchstone/mesh/obstacle_parameters.h>
#include <touchstone/mesh/obstacle_shape.h>

#include <vector>

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
  ObstacleParameters::declare(ParameterHandler &prm, const std::string &chosen_shape)
  {
    if (ObstacleShapeRegistry::records().count(chosen_shape) == 0)
      {
        std::vector<std::string> known;
        for (const auto &[name, record] : ObstacleShapeRegistry::records())
          known.push_back(name);
        throw InputError(section(),
                         "Shape",
                         chosen_shape,
                         "there is no such shape" + did_you_mean(chosen_shape, known),
                         "take one of " + quoted_list(known));
      }
    prm.add_parameter("Shape",
                      shape_name,
                      "The rigid surface, which decides on the other keys here. " +
                        ObstacleShapeRegistry::documentation(),
                      Patterns::Selection(ObstacleShapeRegistry::selection()));
    shape = ObstacleShapeRegistry::make(chosen_shape);
    shape->declare(prm);
    const std::string motion = " component of the rigid motion, a formula in t (time). [length]";
    prm.add_parameter("Motion x", motion_x, "The x" + motion, Patterns::Anything());
    prm.add_parameter("Motion y", motion_y, "The y" + motion, Patterns::Anything());
    prm.add_parameter("Motion z", motion_z, "The z" + motion, Patterns::Anything());
  }



  void
  ObstacleParameters::check(const std::string &section) const
  {
    shape->check(section);
    check_expression(section, "Motion x", motion_x, "t");
    check_expression(section, "Motion y", motion_y, "t");
    check_expression(section, "Motion z", motion_z, "t");
  }
} // namespace Touchstone
