// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/obstacle_shape.h>
#include <touchstone/mesh/sharp_tip.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

// A rigid cone with a tip, sharp or rounded by a sphere to which the cone is tangential: an
// indenter. Unlike the surface of make_cone(), which bodies have, it ends at the tip.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /**
     * In the half plane through x, with coordinates s from the sharp tip along the axis and r away
     * from it, the cone is the ray along t = (cos, sin) of the half angle. Points whose foot on the
     * ray lies before its tangent point with the sphere are projected to the sphere, whose radius
     * may be zero.
     */
    class TippedCone : public AnalyticSurface, public SharpTip
    {
    public:
      TippedCone(const Point<3>     &tip,
                 const Tensor<1, 3> &axis,
                 const double        half_angle,
                 const double        tip_radius,
                 const bool          outside)
        : axis(axis / axis.norm())
        , c(std::cos(half_angle))
        , s(std::sin(half_angle))
        , radius(tip_radius)
        , sign(outside ? 1. : -1.)
        , apex(tip - (tip_radius / s - tip_radius) * this->axis)
        , centre(apex + tip_radius / s * this->axis)
      {
      }

      Point<3>
      project(const Point<3> &x) const override
      {
        const Foot foot = find(x);
        if (foot.on_tip)
          return centre + radius * foot.from_centre;
        return apex + foot.along * (c * axis + s * foot.e);
      }

      Tensor<2, 3>
      projection_gradient(const Point<3> &x) const override
      {
        const Foot foot = find(x);
        if (foot.on_tip)
          // A tangential step is scaled by the ratio of the radii, a radial one is lost; a sharp
          // tip is one point.
          return radius / std::max(foot.distance, 1e-12 * radius + tiniest) *
                 (unit_symmetric_tensor<3>() - outer_product(foot.from_centre, foot.from_centre));
        const Tensor<1, 3> generator = c * axis + s * foot.e;
        const Tensor<1, 3> around    = cross_product_3d(axis, foot.e);
        return outer_product(generator, generator) +
               (foot.along * s / std::max(foot.r, tiniest)) * outer_product(around, around);
      }

      Tensor<1, 3>
      normal(const Point<3> &x) const override
      {
        const Foot foot = find(x);
        return sign * (foot.on_tip ? foot.from_centre : c * foot.e - s * axis);
      }

      bool
      is_before_tip(const Point<3> &x, const double tolerance) const override
      {
        return radius == 0. && cross_product_3d(axis, x - apex).norm() <= tolerance;
      }

      Point<3>
      tip() const override
      {
        return apex;
      }

      Tensor<1, 3>
      normal_at_tip() const override
      {
        return -sign * axis;
      }

    private:
      static constexpr double tiniest = 1e-300;

      const Tensor<1, 3> axis;
      /** Cosine and sine of the half angle. */
      const double c, s, radius, sign;
      /** Where the sides would meet, and the centre of the sphere. */
      const Point<3> apex, centre;

      struct Foot
      {
        bool on_tip;
        /** Distance from the axis, and the direction away from it. */
        double       r;
        Tensor<1, 3> e;
        /** From the apex along the side. */
        double along;
        /** Of the tip: unit vector from the centre to x, and its length. */
        Tensor<1, 3> from_centre;
        double       distance;
      };

      Foot
      find(const Point<3> &x) const
      {
        Foot               foot;
        const Tensor<1, 3> d      = x - apex;
        const double       height = d * axis;
        const Tensor<1, 3> radial = d - height * axis;
        foot.r                    = radial.norm();
        foot.along                = c * height + s * foot.r;
        // On the axis no side is closer than the others. Such a point is one of symmetry, which
        // the tip pushes back along the axis.
        const bool on_axis = foot.r <= 1e-10 * (std::abs(height) + foot.r);
        foot.on_tip        = on_axis || foot.along < radius * c / s;
        if (!foot.on_tip)
          {
            foot.e = radial / foot.r;
            return foot;
          }
        const Tensor<1, 3> from = x - centre;
        foot.distance           = from.norm();
        // At the centre, and within the cone on its axis, as well.
        foot.from_centre = on_axis && from * axis >= -1e-12 * radius
                             ? Tensor<1, 3>(-axis)
                             : Tensor<1, 3>(from / foot.distance);
        return foot;
      }
    };



    class ConeObstacle : public ObstacleShape
    {
    public:
      void
      declare(ParameterHandler &prm) override
      {
        prm.add_parameter("Tip", tip, "The tip of the cone: x, y, z. [length]");
        prm.add_parameter("Direction",
                          axis,
                          "The direction of the axis from the tip into the cone: x, y, z; its "
                          "length does not count.");
        prm.add_parameter("Half angle",
                          half_angle,
                          "The angle between the axis and the side, greater than 0 and less than "
                          "90. [degrees]",
                          Patterns::Double());
        prm.add_parameter("Tip radius",
                          tip_radius,
                          "Radius of a sphere that rounds the tip; 0 is sharp. [length]",
                          Patterns::Double());
        prm.add_parameter("Side",
                          side,
                          "The bodies are 'outside' or 'inside' of the cone.",
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
                           "give the direction from the tip into the cone");
        if (!(half_angle > 0. && half_angle < 90.))
          throw InputError(section,
                           "Half angle",
                           Patterns::Tools::to_string(half_angle),
                           "must lie between 0 and 90 degrees",
                           "give the angle between axis and side; 90 would be a plane");
        if (!(tip_radius >= 0.))
          throw InputError(section,
                           "Tip radius",
                           Patterns::Tools::to_string(tip_radius),
                           "must not be negative",
                           "give 0 for a sharp tip");
      }

      std::shared_ptr<const AnalyticSurface>
      surface() const override
      {
        return std::make_shared<TippedCone>(
          Point<3>(tip), axis, half_angle * numbers::PI / 180., tip_radius, side == "outside");
      }

    private:
      Tensor<1, 3> tip, axis{{0., 0., 1.}};
      double       half_angle = 45., tip_radius = 0.;
      std::string  side = "outside";
    };

    const ObstacleShapeRegistry::Entry<ConeObstacle>
      cone_obstacle("cone", "A cone with a sharp or a round tip, endless in the other direction.");
  } // namespace
} // namespace Touchstone
