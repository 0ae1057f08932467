#ifndef touchstone_mesh_obstacle_parameters_h
#define touchstone_mesh_obstacle_parameters_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/tensor.h>

#include <string>

namespace Touchstone
{
  /** @brief Section "Obstacle NAME": a rigid body given by one formula. */
  struct ObstacleParameters
  {
    std::string name;
    /** "plane", "sphere" or "cylinder". */
    std::string shape = "plane";
    /** A point of the plane, the centre of the sphere, or a point of the axis. */
    dealii::Tensor<1, 3> point;
    /** Outward normal of the plane, or direction of the cylinder's axis. */
    dealii::Tensor<1, 3> direction{{0., 0., 1.}};
    /** Radius of sphere or cylinder, length. */
    double radius = 1.;
    /** The bodies are "outside" of the sphere or cylinder, or "inside". */
    std::string side = "outside";
    /** Rigid motion as expressions in t, length. */
    std::string motion_x = "0", motion_y = "0", motion_z = "0";

    /** @brief "Obstacle NAME". */
    std::string
    section() const;

    void
    declare(dealii::ParameterHandler &prm);
    void
    check(const std::string &section) const;
  };
} // namespace Touchstone

#endif
