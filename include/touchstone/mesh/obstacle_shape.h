#ifndef touchstone_mesh_obstacle_shape_h
#define touchstone_mesh_obstacle_shape_h

#include <touchstone/base/registry.h>
#include <touchstone/mesh/analytic_surface.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>

namespace Touchstone
{
  /**
   * @brief The shape of a rigid obstacle. Registered by the name that the key "Shape" of an
   * obstacle takes; its own keys are in the same section.
   */
  class ObstacleShape
  {
  public:
    virtual ~ObstacleShape() = default;

    virtual void
    declare(dealii::ParameterHandler &prm) = 0;

    /** @throws InputError */
    virtual void
    check(const std::string &section) const = 0;

    /** @brief The surface at time 0; normals point to where the bodies are. */
    virtual std::shared_ptr<const AnalyticSurface>
    surface() const = 0;
  };

  using ObstacleShapeRegistry = Registry<ObstacleShape>;
} // namespace Touchstone

#endif
