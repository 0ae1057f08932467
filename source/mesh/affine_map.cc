// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/affine_map.h>

#include <cmath>

// Bodies that are moved, turned, mirrored and scaled take the shapes along by which they are
// refined and touch: points are mapped back, handed to the original, and the result is mapped.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    class MappedManifold : public Manifold<3>
    {
    public:
      MappedManifold(const std::shared_ptr<Manifold<3>> &original, const AffineMap &map)
        : original(original)
        , map(map)
      {
      }

      std::unique_ptr<Manifold<3>>
      clone() const override
      {
        return std::make_unique<MappedManifold>(original, map);
      }

      Point<3>
      get_new_point(const ArrayView<const Point<3>> &points,
                    const ArrayView<const double>   &weights) const override
      {
        const std::vector<Point<3>> there = back(points);
        return map(original->get_new_point(make_array_view(there), weights));
      }

      void
      get_new_points(const ArrayView<const Point<3>> &points,
                     const Table<2, double>          &weights,
                     ArrayView<Point<3>>              new_points) const override
      {
        const std::vector<Point<3>> there = back(points);
        original->get_new_points(make_array_view(there), weights, new_points);
        for (Point<3> &x : new_points)
          x = map(x);
      }

      Point<3>
      get_intermediate_point(const Point<3> &p1, const Point<3> &p2, const double w) const override
      {
        return map(original->get_intermediate_point(map.back(p1), map.back(p2), w));
      }

      Point<3>
      project_to_manifold(const ArrayView<const Point<3>> &points,
                          const Point<3>                  &candidate) const override
      {
        const std::vector<Point<3>> there = back(points);
        return map(original->project_to_manifold(make_array_view(there), map.back(candidate)));
      }

      Tensor<1, 3>
      get_tangent_vector(const Point<3> &x1, const Point<3> &x2) const override
      {
        return map.linear() * original->get_tangent_vector(map.back(x1), map.back(x2));
      }

    private:
      const std::shared_ptr<Manifold<3>> original;
      const AffineMap                    map;

      std::vector<Point<3>>
      back(const ArrayView<const Point<3>> &points) const
      {
        std::vector<Point<3>> result;
        result.reserve(points.size());
        for (const Point<3> &x : points)
          result.push_back(map.back(x));
        return result;
      }
    };



    class MappedSurface : public AnalyticSurface
    {
    public:
      MappedSurface(const std::shared_ptr<const AnalyticSurface> &original, const AffineMap &map)
        : original(original)
        , map(map)
        , turn(map.linear() / std::cbrt(std::abs(determinant(map.linear()))))
      {
      }

      Point<3>
      project(const Point<3> &x) const override
      {
        return map(original->project(map.back(x)));
      }

      Tensor<2, 3>
      projection_gradient(const Point<3> &x) const override
      {
        return turn * original->projection_gradient(map.back(x)) * transpose(turn);
      }

      Point<3>
      project_with(const Point<3> &x, std::array<Tensor<1, 3>, 2> &directions) const override
      {
        for (Tensor<1, 3> &direction : directions)
          direction = transpose(turn) * direction;
        const Point<3> result = map(original->project_with(map.back(x), directions));
        for (Tensor<1, 3> &direction : directions)
          direction = turn * direction;
        return result;
      }

      Tensor<1, 3>
      normal(const Point<3> &x) const override
      {
        // Also where the map mirrors: outside stays outside.
        return turn * original->normal(map.back(x));
      }

    private:
      const std::shared_ptr<const AnalyticSurface> original;
      const AffineMap                              map;
      /** The orthogonal part of the map. */
      const Tensor<2, 3> turn;
    };
  } // namespace



  AffineMap::AffineMap(const Tensor<2, 3> &matrix, const Tensor<1, 3> &shift)
    : matrix(matrix)
    , inverse(invert(matrix))
    , shift(shift)
  {
  }



  std::shared_ptr<Manifold<3>>
  mapped_manifold(const std::shared_ptr<Manifold<3>> &original, const AffineMap &map)
  {
    return std::make_shared<MappedManifold>(original, map);
  }



  std::shared_ptr<const AnalyticSurface>
  mapped_surface(const std::shared_ptr<const AnalyticSurface> &original, const AffineMap &map)
  {
    return std::make_shared<MappedSurface>(original, map);
  }
} // namespace Touchstone
