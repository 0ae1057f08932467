// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/obstacle_shape.h>

// The shapes of rigid obstacles: keys of the input and the exact surface that they describe. The
// normal points to the side of the bodies, as that of a master surface does.
namespace Touchstone
{
  using dealii::ParameterHandler;
  using dealii::Point;
  using dealii::Tensor;
  namespace Patterns = dealii::Patterns;

  namespace
  {
    void
    declare_point(ParameterHandler &prm, Tensor<1, 3> &point, const std::string &what)
    {
      prm.add_parameter("Point", point, what + ": x, y, z. [length]");
    }

    void
    check_direction(const std::string  &section,
                    const Tensor<1, 3> &direction,
                    const std::string  &remedy)
    {
      if (direction.norm() == 0.)
        // A vector of length zero has no direction; any other length is normalised later.
        throw InputError(
          section, "Direction", Patterns::Tools::to_string(direction), "must not be zero", remedy);
    }

    /** Keys of what has a radius, and bodies outside or inside. */
    struct Round
    {
      double      radius = 1.;
      std::string side   = "outside";

      void
      declare(ParameterHandler &prm, const std::string &shape)
      {
        prm.add_parameter("Radius",
                          radius,
                          "Radius of the " + shape + ", greater than zero. [length]",
                          Patterns::Double());
        prm.add_parameter("Side",
                          side,
                          "The bodies are 'outside' or 'inside' of the " + shape + ".",
                          Patterns::Selection("outside|inside"));
      }

      void
      check(const std::string &section, const std::string &shape) const
      {
        if (!(radius > 0.))
          throw InputError(section,
                           "Radius",
                           Patterns::Tools::to_string(radius),
                           "must be positive",
                           "give the radius of the " + shape);
      }

      bool
      outside() const
      {
        return side == "outside";
      }
    };



    class PlaneObstacle : public ObstacleShape
    {
    public:
      void
      declare(ParameterHandler &prm) override
      {
        declare_point(prm, point, "A point of the plane");
        prm.add_parameter("Direction",
                          normal,
                          "The plane's normal, pointing to where the bodies are: x, y, z; its "
                          "length does not count.");
      }

      void
      check(const std::string &section) const override
      {
        check_direction(section,
                        normal,
                        "give the normal of the plane or the axis of the cylinder");
      }

      std::shared_ptr<const AnalyticSurface>
      surface() const override
      {
        // The half space on the side of the normal is free, the other one is the obstacle.
        return make_plane(Point<3>(point), normal / normal.norm());
      }

    private:
      Tensor<1, 3> point, normal{{0., 0., 1.}};
    };



    class SphereObstacle : public ObstacleShape
    {
    public:
      void
      declare(ParameterHandler &prm) override
      {
        declare_point(prm, centre, "The centre of the sphere");
        round.declare(prm, "sphere");
      }

      void
      check(const std::string &section) const override
      {
        round.check(section, "sphere");
      }

      std::shared_ptr<const AnalyticSurface>
      surface() const override
      {
        return make_sphere(Point<3>(centre), round.radius, round.outside());
      }

    private:
      Tensor<1, 3> centre;
      Round        round;
    };



    class CylinderObstacle : public ObstacleShape
    {
    public:
      void
      declare(ParameterHandler &prm) override
      {
        declare_point(prm, point, "A point of the cylinder's axis");
        prm.add_parameter("Direction",
                          axis,
                          "The direction of the cylinder's axis: x, y, z; its length does not "
                          "count.");
        round.declare(prm, "cylinder");
      }

      void
      check(const std::string &section) const override
      {
        check_direction(section, axis, "give the normal of the plane or the axis of the cylinder");
        round.check(section, "cylinder");
      }

      std::shared_ptr<const AnalyticSurface>
      surface() const override
      {
        // A cylinder is a cone of slope zero, and infinitely long, like the plane is infinitely
        // wide.
        return make_cone(Point<3>(point), axis / axis.norm(), round.radius, 0., round.outside());
      }

    private:
      Tensor<1, 3> point, axis{{0., 0., 1.}};
      Round        round;
    };

    const ObstacleShapeRegistry::Entry<PlaneObstacle>    plane_obstacle("plane", "A plane.");
    const ObstacleShapeRegistry::Entry<SphereObstacle>   sphere_obstacle("sphere", "A sphere.");
    const ObstacleShapeRegistry::Entry<CylinderObstacle> cylinder_obstacle("cylinder",
                                                                           "A cylinder.");
  } // namespace
} // namespace Touchstone
