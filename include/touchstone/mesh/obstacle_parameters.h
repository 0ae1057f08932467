#ifndef touchstone_mesh_obstacle_parameters_h
#define touchstone_mesh_obstacle_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>

namespace Touchstone
{
  class ObstacleShape;

  /** @brief Section "Obstacle NAME": a rigid body given by one formula. */
  struct ObstacleParameters
  {
    std::string name;
    /** Name under which the shape is registered, and that with its own parameters read. */
    std::string                    shape_name = "plane";
    std::shared_ptr<ObstacleShape> shape;
    /** Rigid motion as expressions in t, length. */
    std::string motion_x = "0", motion_y = "0", motion_z = "0";

    /** @brief "Obstacle NAME". */
    std::string
    section() const;

    /** @param chosen_shape The shape that the scene sets, for its own keys.
     * @throws InputError if there is none of this name */
    void
    declare(dealii::ParameterHandler &prm, const std::string &chosen_shape);
    void
    check(const std::string &section) const;
  };
} // namespace Touchstone

#endif
