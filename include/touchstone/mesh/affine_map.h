// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_affine_map_h
#define touchstone_mesh_affine_map_h

#include <touchstone/mesh/analytic_surface.h>

#include <deal.II/base/tensor.h>
#include <deal.II/grid/manifold.h>

namespace Touchstone
{
  /** @brief x -> A x + b with an invertible A. */
  class AffineMap
  {
  public:
    AffineMap(const dealii::Tensor<2, 3> &matrix, const dealii::Tensor<1, 3> &shift);

    dealii::Point<3>
    operator()(const dealii::Point<3> &x) const
    {
      return dealii::Point<3>(matrix * x + shift);
    }
    dealii::Point<3>
    back(const dealii::Point<3> &x) const
    {
      return dealii::Point<3>(inverse * (x - shift));
    }
    /** @brief A. */
    const dealii::Tensor<2, 3> &
    linear() const
    {
      return matrix;
    }
    /** @brief The map turns right-handed systems into left-handed ones. */
    bool
    mirrors() const
    {
      return determinant(matrix) < 0.;
    }

  private:
    dealii::Tensor<2, 3> matrix, inverse;
    dealii::Tensor<1, 3> shift;
  };

  /** @brief The manifold whose points are those of @p original, mapped. */
  std::shared_ptr<dealii::Manifold<3>>
  mapped_manifold(const std::shared_ptr<dealii::Manifold<3>> &original, const AffineMap &map);

  /** @brief The surface whose points are those of @p original, mapped; the linear part of the map
   * must be a multiple of an orthogonal matrix, or closest points would not stay closest. */
  std::shared_ptr<const AnalyticSurface>
  mapped_surface(const std::shared_ptr<const AnalyticSurface> &original, const AffineMap &map);
} // namespace Touchstone

#endif
