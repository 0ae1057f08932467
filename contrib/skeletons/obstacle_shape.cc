// SPDX-License-Identifier: LGPL-2.1-or-later
// A shape of rigid obstacles to start from. Copy to source/mesh/NAME.cc and change what is
// marked TODO: 'set Shape = NAME' selects it, and nothing else need be edited.

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/obstacle_shape.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>

namespace Touchstone
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;

    /** TODO: the surface by its closest-point projection: here a torus, the points at the
     * distance r of a circle of radius R about the z direction. */
    class TorusSurface : public AnalyticSurface
    {
    public:
      TorusSurface(const Point<3> &centre, const double R, const double r)
        : centre(centre)
        , R(R)
        , r(r)
      {
      }

      Point<3>
      project(const Point<3> &x) const override
      {
        const Tensor<1, 3> d = x - on_circle(x);
        return on_circle(x) + r / d.norm() * d;
      }

      Tensor<2, 3>
      projection_gradient(const Point<3> &x) const override
      {
        // The point q of the circle turns with x, by R/rho of its motion around the axis.
        const Tensor<2, 3> identity(dealii::unit_symmetric_tensor<3>());
        const Tensor<1, 3> e = radial(x), n = normal(x);
        const Tensor<1, 3> around({-e[1], e[0], 0.});
        const double       rho = std::max((x - centre) * e, 1e-12 * R);
        const Tensor<2, 3> dq  = R / rho * outer_product(around, around);
        return dq +
               r / (x - on_circle(x)).norm() * (identity - outer_product(n, n)) * (identity - dq);
      }

      Tensor<1, 3>
      normal(const Point<3> &x) const override
      {
        const Tensor<1, 3> d = x - on_circle(x);
        return d / d.norm();
      }

    private:
      const Point<3> centre;
      const double   R, r;

      /** Direction away from the axis; on it every direction leads to a closest point. */
      Tensor<1, 3>
      radial(const Point<3> &x) const
      {
        Tensor<1, 3> e = x - centre;
        e[2]           = 0.;
        return e.norm() > 1e-12 * R ? e / e.norm() : Tensor<1, 3>({1., 0., 0.});
      }

      Point<3>
      on_circle(const Point<3> &x) const
      {
        return centre + R * radial(x);
      }
    };



    class Torus : public ObstacleShape
    {
    public:
      void
      declare(dealii::ParameterHandler &prm) override
      {
        // TODO: the keys, with their units.
        prm.add_parameter("Centre", centre, "Centre of the torus: x, y, z. [length]");
        prm.add_parameter("Radius", R, "Radius of the circle in its middle. [length]");
        prm.add_parameter("Tube radius", r, "Radius of the tube around it. [length]");
      }

      void
      check(const std::string &section) const override
      {
        // TODO: each value that makes no sense, with what to do about it.
        if (!(r > 0. && r < R))
          throw InputError(section,
                           "Tube radius",
                           dealii::Patterns::Tools::to_string(r),
                           "must be positive and less than 'Radius'",
                           "a tube that meets itself has no outside everywhere");
      }

      std::shared_ptr<const AnalyticSurface>
      surface() const override
      {
        return std::make_shared<TorusSurface>(Point<3>(centre), R, r);
      }

    private:
      Tensor<1, 3> centre;
      double       R = 1., r = 0.25;
    };

    // TODO: the name that scenes use, and a sentence for the reference of keys.
    const ObstacleShapeRegistry::Entry<Torus> torus("my torus", "A torus about the z direction.");
  } // namespace
} // namespace Touchstone
