// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_geometry_h
#define touchstone_mesh_geometry_h

#include <touchstone/base/registry.h>
#include <touchstone/mesh/analytic_surface.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/grid/manifold.h>
#include <deal.II/grid/tria_description.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The coarse mesh of one body, with boundary and manifold ids that are
   * its own (the forest renumbers them).
   */
  struct BodyMesh
  {
    std::vector<dealii::Point<3>>    vertices;
    std::vector<dealii::CellData<3>> cells;
    /** Faces with boundary ids (every boundary face has one) and manifold ids. */
    dealii::SubCellData subcells;
    /** Names of boundary ids; a boundary can also be called by its number. */
    std::map<std::string, dealii::types::boundary_id> boundary_names;
    /** Boundary ids of faces that belong to several boundaries, with the ids of these. */
    std::map<dealii::types::boundary_id, std::set<dealii::types::boundary_id>> shared;
    /** Sets of vertices: edges, points, or any others. */
    std::map<std::string, std::set<unsigned int>> node_sets;
    /** Manifolds of cells and faces for refinement and curved mappings. */
    std::map<dealii::types::manifold_id, std::shared_ptr<dealii::Manifold<3>>> manifolds;
    /** Exact shape of curved boundaries, for contact. */
    std::map<dealii::types::boundary_id, std::shared_ptr<const AnalyticSurface>> surfaces;
    /** How far nodes in the middle of edges and faces that a mesh file gives lie off the straight
     * cells, length: what elements of degree 1 do not have. */
    double bulge = 0.;
  };

  /**
   * @brief How a body is shaped and meshed. Registered by name; its parameters
   * stand in the subsection "Body NAME/Geometry".
   */
  class Geometry : public PluginParameters
  {
  public:
    /**
     * @brief Make the coarse mesh.
     * @param factor  Multiplies the cells of each direction, 0.5 < factor < 2;
     *                1 leaves them as given (the forest refines by powers of two).
     * @param section Section for error messages.
     * @param folder  Folder of the scene file, for relative mesh file names.
     * @throws InputError e.g. for a mesh file that cannot be read.
     */
    virtual BodyMesh
    create(double factor, const std::string &section, const std::string &folder) const = 0;

    /**
     * @brief A fingerprint of a mesh that is not made from parameters alone:
     * size and checksum of its file; empty if parameters say all.
     * @param folder Folder of the scene file.
     */
    virtual std::string
    fingerprint(const std::string & /*folder*/) const
    {
      return "";
    }
  };

  using GeometryRegistry = Registry<Geometry>;
} // namespace Touchstone

#endif
