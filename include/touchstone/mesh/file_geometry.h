// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_file_geometry_h
#define touchstone_mesh_file_geometry_h

#include <touchstone/mesh/body_mesh.h>
#include <touchstone/mesh/geometry.h>
#include <touchstone/mesh/mesh_file.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/types.h>

#include <map>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief A body, or one of several, from a mesh file. */
  class FileGeometry : public Geometry
  {
  public:
    void
    declare(dealii::ParameterHandler &prm) override;
    void
    check(const std::string &section) const override;
    BodyMesh
    create(double factor, const std::string &section, const std::string &folder) const override;
    std::string
    fingerprint(const std::string &folder) const override;

  private:
    std::string                                       file, volume, exact;
    std::map<std::string, dealii::types::boundary_id> extra_names;
    std::vector<std::string>                          boundary_arrays;

    MeshFile
    read(const std::string &section, const std::string &folder) const;
    /** Vertices and cells of the body, the body's numbers of the file's
     * vertices, and the file's numbers of the cells. */
    BodyMesh
    select(const MeshFile                       &mesh_file,
           std::map<unsigned int, unsigned int> &vertex_numbers,
           std::vector<unsigned int>            &cell_numbers,
           const std::string                    &section) const;
    /** Give the cells the curved shape that mid nodes describe. */
    void
    curve(BodyMesh                                   &mesh,
          const MeshFile                             &mesh_file,
          const std::map<unsigned int, unsigned int> &vertex_numbers,
          const std::vector<unsigned int>            &cell_numbers,
          const std::string                          &section) const;
    void
    orient(BodyMesh &mesh, const std::string &section) const;
    void
    mark(BodyMesh                                   &mesh,
         const MeshFile                             &mesh_file,
         const std::map<unsigned int, unsigned int> &vertex_numbers,
         const std::string                          &section) const;
    /** Take the sets of nodes that the body has. */
    void
    take_sets(BodyMesh                                   &mesh,
              const MeshFile                             &mesh_file,
              const std::map<unsigned int, unsigned int> &vertex_numbers,
              const std::vector<unsigned int>            &cell_numbers,
              const std::string                          &section) const;
    void
    attach_exact_surfaces(BodyMesh &mesh, const std::string &section) const;
  };
} // namespace Touchstone

#endif
