// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_obstacle_parameters_h
#define touchstone_mesh_obstacle_parameters_h

#include <touchstone/base/choice.h>
#include <touchstone/mesh/free_motion_parameters.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/tensor.h>

#include <string>

namespace Touchstone
{
  class ObstacleShape;

  /** @brief Section "Obstacle NAME": a rigid body given by one formula. */
  struct ObstacleParameters
  {
    std::string name;
    /** The shape, whose own keys stand beside this one. */
    Choice<Registry<ObstacleShape>> shape{"plane"};
    /** Rigid motion as expressions in t, length. */
    std::string motion_x = "0", motion_y = "0", motion_z = "0";
    /** Rotation before this translation: an expression in t, degrees, about an axis through a
     * point. */
    std::string          rotate_angle = "0";
    dealii::Tensor<1, 3> rotate_axis{{0., 0., 1.}}, rotate_point;
    /** What follows from forces instead. */
    FreeMotionParameters free;

    /** @brief "Obstacle NAME". */
    std::string
    section() const;

    /** @param values Of this section: the shape decides on other keys. */
    void
    declare(dealii::ParameterHandler &prm, const EarlyValues &values);
    void
    check(const std::string &section) const;
  };
} // namespace Touchstone

#endif
