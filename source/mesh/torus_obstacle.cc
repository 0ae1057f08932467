// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/obstacle_shape.h>

#include <algorithm>
#include <cmath>

// A rigid torus: a ring of circular section, or a channel around bodies.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** In the half plane from the axis through x the section is a circle of the minor radius, whose
     * centre is at the major radius: x is projected to that circle. */
    class Torus : public AnalyticSurface
    {
    public:
      Torus(const Point<3>     &centre,
            const Tensor<1, 3> &axis,
            const double        radius,
            const double        tube,
            const bool          outside)
        : centre(centre)
        , axis(axis / axis.norm())
        , radius(radius)
        , tube(tube)
        , sign(outside ? 1. : -1.)
      {
        unsigned int smallest = 0;
        for (unsigned int d = 1; d < 3; ++d)
          if (std::abs(this->axis[d]) < std::abs(this->axis[smallest]))
            smallest = d;
        elsewhere = cross_product_3d(this->axis, Point<3>::unit_vector(smallest));
        elsewhere /= elsewhere.norm();
      }

      Point<3>
      project(const Point<3> &x) const override
      {
        const Foot foot = find(x);
        return centre + radius * foot.e + tube * foot.from_circle;
      }

      Tensor<2, 3>
      projection_gradient(const Point<3> &x) const override
      {
        // Steps around the tube and around the axis are scaled by the ratios of the radii, a step
        // along the normal is lost.
        const Foot         foot     = find(x);
        const Tensor<1, 3> around   = cross_product_3d(axis, foot.e);
        const Tensor<1, 3> meridian = cross_product_3d(around, foot.from_circle);
        const double       r        = radius + tube * (foot.from_circle * foot.e);
        return (tube / foot.distance) * outer_product(meridian, meridian) +
               (r / foot.r_of_x) * outer_product(around, around);
      }

      Tensor<1, 3>
      normal(const Point<3> &x) const override
      {
        return sign * find(x).from_circle;
      }

    private:
      const Point<3>     centre;
      const Tensor<1, 3> axis;
      /** Major and minor radius. */
      const double radius, tube, sign;
      /** Radial direction that is taken for points on the axis. */
      Tensor<1, 3> elsewhere;

      struct Foot
      {
        /** Away from the axis, and the distance from it. */
        Tensor<1, 3> e;
        double       r_of_x;
        /** Unit vector from the centre of the section to x, and their distance. */
        Tensor<1, 3> from_circle;
        double       distance;
      };

      Foot
      find(const Point<3> &x) const
      {
        const Tensor<1, 3> d      = x - centre;
        const Tensor<1, 3> radial = d - (d * axis) * axis;
        const double       tiny = 1e-12 * tube, r = radial.norm();
        const Tensor<1, 3> e      = r > tiny ? Tensor<1, 3>(radial / r) : elsewhere;
        const Tensor<1, 3> from   = d - radius * e;
        const double       length = from.norm();
        // At the centre of the section all points of its circle are equally close.
        return {e,
                std::max(r, tiny),
                length > tiny ? Tensor<1, 3>(from / length) : axis,
                std::max(length, tiny)};
      }
    };



    class TorusObstacle : public ObstacleShape
    {
    public:
      void
      declare(ParameterHandler &prm) override
      {
        prm.add_parameter("Centre", centre, "The centre of the torus: x, y, z. [length]");
        prm.add_parameter("Direction",
                          axis,
                          "The direction of its axis: x, y, z; its length does not count.");
        prm.add_parameter("Radius",
                          radius,
                          "Radius of the circle on which the centres of its sections lie, greater "
                          "than that of the tube. [length]",
                          Patterns::Double());
        prm.add_parameter("Tube radius",
                          tube,
                          "Radius of its sections, greater than zero. [length]",
                          Patterns::Double());
        prm.add_parameter("Side",
                          side,
                          "The bodies are 'outside' or 'inside' of the tube.",
                          Patterns::Selection("outside|inside"));
      }

      void
      check(const std::string &section) const override
      {
        if (axis.norm() == 0.)
          throw InputError(section,
                           "Direction",
                           Patterns::Tools::to_string(axis),
                           "must not be zero",
                           "give the direction of the axis of the torus");
        if (!(tube > 0.))
          throw InputError(section,
                           "Tube radius",
                           Patterns::Tools::to_string(tube),
                           "must be positive",
                           "give the radius of the section");
        if (!(radius > tube))
          throw InputError(section,
                           "Radius",
                           Patterns::Tools::to_string(radius),
                           "must be greater than 'Tube radius' (" +
                             Patterns::Tools::to_string(tube) +
                             "): the torus would meet itself on its axis",
                           "give the radius of the circle of centres, or take a sphere");
      }

      std::shared_ptr<const AnalyticSurface>
      surface() const override
      {
        return std::make_shared<Torus>(Point<3>(centre), axis, radius, tube, side == "outside");
      }

    private:
      Tensor<1, 3> centre, axis{{0., 0., 1.}};
      double       radius = 1., tube = 0.25;
      std::string  side = "outside";
    };

    const ObstacleShapeRegistry::Entry<TorusObstacle>
      torus_obstacle("torus", "A torus: a ring of circular section.");
  } // namespace
} // namespace Touchstone
