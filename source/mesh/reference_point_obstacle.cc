// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/obstacle_shape.h>

#include <deal.II/base/symmetric_tensor.h>

// A rigid body without a surface of its own: boundaries that are tied to it move as rigid bodies,
// driven by its motion or by force and moment at its reference point (doc/theory.md 4.5).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Every point is on it: tied nodes keep the place that they have. */
    class Everywhere : public AnalyticSurface
    {
    public:
      Point<3>
      project(const Point<3> &x) const override
      {
        return x;
      }

      Tensor<2, 3>
      projection_gradient(const Point<3> &) const override
      {
        return static_cast<Tensor<2, 3>>(unit_symmetric_tensor<3>());
      }

      Tensor<1, 3>
      normal(const Point<3> &) const override
      {
        return Point<3>::unit_vector(2);
      }
    };

    class ReferencePointObstacle : public ObstacleShape
    {
    public:
      std::shared_ptr<const AnalyticSurface>
      surface() const override
      {
        return std::make_shared<Everywhere>();
      }
    };

    const ObstacleShapeRegistry::Entry<ReferencePointObstacle>
      reference_point_obstacle("reference point",
                               "No surface: what is tied to it moves as a rigid body.");
  } // namespace
} // namespace Touchstone
