// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/analytic_surface.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

// Exact surfaces as closest-point maps P(x) with their derivative (doc/theory.md, section 4,
// equation (8)): plane, sphere and cone, of which the cylinder is the case of slope zero. Contact
// takes positions and normals from them, so that the facets of the mesh do not enter the gap.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    const Tensor<2, 3> identity = unit_symmetric_tensor<3>();

    /** Any unit vector perpendicular to @p direction: used for points on an axis, where every
     * radial direction leads to a closest point. */
    Tensor<1, 3>
    some_perpendicular(const Tensor<1, 3> &direction)
    {
      // The axis that is farthest from parallel keeps the subtraction below free of cancellation.
      unsigned int smallest = 0;
      for (unsigned int d = 1; d < 3; ++d)
        if (std::abs(direction[d]) < std::abs(direction[smallest]))
          smallest = d;
      Tensor<1, 3> e;
      e[smallest] = 1.;
      e -= (e * direction) * direction;
      return e / e.norm();
    }



    class Plane : public AnalyticSurface
    {
    public:
      Plane(const Point<3> &point, const Tensor<1, 3> &normal)
        : point(point)
        , n(normal / normal.norm())
      {
      }

      Point<3>
      project(const Point<3> &x) const override
      {
        return x - ((x - point) * n) * n;
      }

      Tensor<2, 3>
      projection_gradient(const Point<3> &) const override
      {
        return identity - outer_product(n, n);
      }

      Tensor<1, 3>
      normal(const Point<3> &) const override
      {
        return n;
      }

    private:
      const Point<3>     point;
      const Tensor<1, 3> n;
    };



    class Sphere : public AnalyticSurface
    {
    public:
      Sphere(const Point<3> &centre, const double radius, const bool outside)
        : centre(centre)
        , radius(radius)
        , sign(outside ? 1. : -1.)
      {
      }

      Point<3>
      project(const Point<3> &x) const override
      {
        return centre + radius * direction(x);
      }

      Tensor<2, 3>
      projection_gradient(const Point<3> &x) const override
      {
        // A tangential step is scaled by the ratio of the radii, a radial one is lost. At the
        // centre the map has no derivative; the bound on r keeps it finite there.
        const Tensor<1, 3> e = direction(x);
        const double       r = std::max((x - centre).norm(), tiny());
        return (radius / r) * (identity - outer_product(e, e));
      }

      Tensor<1, 3>
      normal(const Point<3> &x) const override
      {
        return sign * direction(x);
      }

    private:
      const Point<3> centre;
      const double   radius, sign;

      double
      tiny() const
      {
        return 1e-12 * radius;
      }

      /** Unit vector from the centre to @p x; the z direction at the centre. */
      Tensor<1, 3>
      direction(const Point<3> &x) const
      {
        const Tensor<1, 3> d = x - centre;
        return d.norm() > tiny() ? d / d.norm() : Tensor<1, 3>({0., 0., 1.});
      }
    };



    /**
     * In the half plane through x, with coordinates s along the axis and r away
     * from it, the cone is the straight line r = radius + slope s, to which x is
     * projected. Valid where the line's foot has r > 0, i.e. not beyond the apex.
     */
    class Cone : public AnalyticSurface
    {
    public:
      Cone(const Point<3>     &point,
           const Tensor<1, 3> &axis,
           const double        radius,
           const double        slope,
           const bool          outside)
        : point(point)
        , axis(axis / axis.norm())
        , elsewhere(some_perpendicular(this->axis))
        , radius(radius)
        , slope(slope)
        , q(std::sqrt(1. + slope * slope))
        , sign(outside ? 1. : -1.)
      {
      }

      Point<3>
      project(const Point<3> &x) const override
      {
        const Foot foot = find(x);
        return point + foot.s * axis + foot.r * foot.e;
      }

      Tensor<2, 3>
      projection_gradient(const Point<3> &x) const override
      {
        // A step along the generator is kept, a step around the axis shrinks
        // with the distance from it, a step along the normal is lost.
        const Foot         foot    = find(x);
        const Tensor<1, 3> tangent = (axis + slope * foot.e) / q;
        const Tensor<1, 3> around  = cross_product_3d(axis, foot.e);
        return outer_product(tangent, tangent) +
               (foot.r / foot.r_of_x) * outer_product(around, around);
      }

      Point<3>
      project_with(const Point<3> &x, std::array<Tensor<1, 3>, 2> &directions) const override
      {
        // Point and derivative from one evaluation of the foot, along the two tangents of a face
        // alone: this is called for each evaluation of a position in the search for the closest
        // point.
        const Foot         foot    = find(x);
        const Tensor<1, 3> tangent = (axis + slope * foot.e) / q;
        const Tensor<1, 3> around  = cross_product_3d(axis, foot.e);
        for (Tensor<1, 3> &direction : directions)
          direction = (tangent * direction) * tangent +
                      (foot.r / foot.r_of_x * (around * direction)) * around;
        return point + foot.s * axis + foot.r * foot.e;
      }

      Tensor<1, 3>
      normal(const Point<3> &x) const override
      {
        return sign * (find(x).e - slope * axis) / q;
      }

    private:
      const Point<3>     point;
      const Tensor<1, 3> axis;
      /** Radial direction that is taken for points on the axis. */
      const Tensor<1, 3> elsewhere;
      const double       radius, slope, q, sign;

      /** Closest point (s, r) on the generator, and the radial direction e. */
      struct Foot
      {
        double       s, r, r_of_x;
        Tensor<1, 3> e;
      };

      Foot
      find(const Point<3> &x) const
      {
        const Tensor<1, 3> d       = x - point;
        const double       s       = d * axis;
        const Tensor<1, 3> radial  = d - s * axis;
        const double       r       = radial.norm();
        const double       tiny    = 1e-12 * (std::abs(radius + slope * s) + r);
        const bool         on_axis = r <= tiny;

        // Signed distance from the generator in the half plane through x, whose normal is
        // (-slope, 1) / q in (s, r).
        const double distance = (r - radius - slope * s) / q;
        return {s + distance * slope / q,
                r - distance / q,
                on_axis ? tiny : r,
                on_axis ? elsewhere : radial / r};
      }
    };
  } // namespace



  std::shared_ptr<const AnalyticSurface>
  make_plane(const Point<3> &point, const Tensor<1, 3> &normal)
  {
    return std::make_shared<Plane>(point, normal);
  }



  std::shared_ptr<const AnalyticSurface>
  make_sphere(const Point<3> &centre, const double radius, const bool outside)
  {
    return std::make_shared<Sphere>(centre, radius, outside);
  }



  std::shared_ptr<const AnalyticSurface>
  make_cone(const Point<3>     &point,
            const Tensor<1, 3> &axis,
            const double        radius,
            const double        slope,
            const bool          outside)
  {
    return std::make_shared<Cone>(point, axis, radius, slope, outside);
  }
} // namespace Touchstone
