// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_analytic_surface_h
#define touchstone_mesh_analytic_surface_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <memory>

namespace Touchstone
{
  /**
   * @brief A surface given by a formula: the exact shape of a curved boundary,
   * from which contact takes gaps and normals instead of from the facets, and
   * the shape of a rigid obstacle.
   */
  class AnalyticSurface
  {
  public:
    virtual ~AnalyticSurface() = default;

    /** @brief Closest point of the surface, length. */
    virtual dealii::Point<3>
    project(const dealii::Point<3> &x) const = 0;

    /** @brief Derivative of project() with respect to @p x, 3 x 3, symmetric. */
    virtual dealii::Tensor<2, 3>
    projection_gradient(const dealii::Point<3> &x) const = 0;

    /** @brief project(), and two directions times projection_gradient(), at the price of
     * little more than one of them. */
    virtual dealii::Point<3>
    project_with(const dealii::Point<3> &x, std::array<dealii::Tensor<1, 3>, 2> &directions) const
    {
      const dealii::Tensor<2, 3> gradient = projection_gradient(x);
      for (dealii::Tensor<1, 3> &direction : directions)
        direction = gradient * direction;
      return project(x);
    }

    /** @brief Unit normal at the closest point of @p x; points away from the
     * material that the surface bounds. */
    virtual dealii::Tensor<1, 3>
    normal(const dealii::Point<3> &x) const = 0;

    /** @brief Whether what is at @p x can touch it: of a wall, which is a part of a surface, not
     * what is closer to another part; see FacetWalls. */
    virtual bool
    can_be_touched(const dealii::Point<3> & /*x*/) const
    {
      return true;
    }
  };

  /** @brief The plane through @p point with outward @p normal. */
  std::shared_ptr<const AnalyticSurface>
  make_plane(const dealii::Point<3> &point, const dealii::Tensor<1, 3> &normal);

  /** @brief A sphere; @p outside says that material is within and the normal
     points away from the centre. */
  std::shared_ptr<const AnalyticSurface>
  make_sphere(const dealii::Point<3> &centre, double radius, bool outside);

  /**
   * @brief A cylinder or cone of revolution, r(s) = radius + slope * s, where s
   * is the coordinate along @p axis from @p point.
   */
  std::shared_ptr<const AnalyticSurface>
  make_cone(const dealii::Point<3>     &point,
            const dealii::Tensor<1, 3> &axis,
            double                      radius,
            double                      slope,
            bool                        outside);
} // namespace Touchstone

#endif
