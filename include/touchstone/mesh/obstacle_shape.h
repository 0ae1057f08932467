// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_obstacle_shape_h
#define touchstone_mesh_obstacle_shape_h

#include <touchstone/base/registry.h>
#include <touchstone/mesh/analytic_surface.h>

#include <memory>
#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The shape of a rigid obstacle. Registered by the name that the key "Shape" of an
   * obstacle takes; its own keys are in the same section.
   */
  class ObstacleShape : public PluginParameters
  {
  public:
    /** @brief The surface at time 0; normals point to where the bodies are. */
    virtual std::shared_ptr<const AnalyticSurface>
    surface() const = 0;

    /** @brief Parts of the surface that pairs are made of one by one, as a point can touch several
     * at the same time, see FacetWalls; none: the surface as a whole. */
    virtual std::vector<std::shared_ptr<const AnalyticSurface>>
    walls() const
    {
      return {};
    }

    /** @brief The surface is taken as a whole, but has edges that look inwards. */
    virtual bool
    has_inner_edges() const
    {
      return false;
    }

    /** @brief Folder of the scene file, for relative names of files; comes before surface(). */
    virtual void
    set_folder(const std::string & /*of_scene*/)
    {
    }

    /** @brief As Geometry::fingerprint(). */
    virtual std::string
    fingerprint() const
    {
      return "";
    }
  };

  using ObstacleShapeRegistry = Registry<ObstacleShape>;
} // namespace Touchstone

#endif
