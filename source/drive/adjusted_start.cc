// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/drive/adjusted_start.h>
#include <touchstone/explicit/general/adjusted_surfaces.h>
#include <touchstone/scene/pair_input.h>
#include <touchstone/solid/solid.h>

#include <cstdio>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The normals of planes of symmetry at their nodes, of all ranks. */
    AdjustedSurfaces::Planes
    planes_of_symmetry(const Scene &scene, const Forest &forest, const Solid &solid)
    {
      struct At
      {
        Index          dof;
        Tensor<1, dim> normal;
      };
      std::vector<BoundaryIds> ids;
      for (unsigned int b = 0; b < scene.bodies.size(); ++b)
        ids.push_back(
          forest.boundary_ids(b, scene.bodies[b].symmetry, scene.bodies[b].section(), "Symmetry"));
      // A plane has one normal, whatever the face.
      std::map<std::pair<Index, types::boundary_id>, Tensor<1, dim>> found;
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int f : cell->face_indices())
            if (const auto face = cell->face(f);
                face->at_boundary() && ids[cell->material_id()].count(face->boundary_id()) > 0)
              {
                const Tensor<1, dim> normal = cross_product_3d(face->vertex(3) - face->vertex(0),
                                                               face->vertex(2) - face->vertex(1));
                for (const unsigned int v : face->vertex_indices())
                  found[{face->vertex_dof_index(v, 0, cell->active_fe_index()),
                         face->boundary_id()}] = normal / normal.norm();
              }
      std::vector<At> mine;
      for (const auto &[where, normal] : found)
        mine.push_back({where.first, normal});
      AdjustedSurfaces::Planes result;
      for (const At &one : gather_all(mine, solid.communicator))
        result.emplace(one.dof, one.normal);
      return result;
    }



    void
    move_vertices(const std::map<Index, Tensor<1, dim>> &motions,
                  const Solid                           &solid,
                  Forest                                &forest)
    {
      std::vector<bool> moved(forest.triangulation.n_vertices());
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
          for (const unsigned int v : cell->vertex_indices())
            {
              const auto motion = motions.find(cell->vertex_dof_index(v, 0));
              if (motion == motions.end() || moved[cell->vertex_index(v)])
                continue;
              moved[cell->vertex_index(v)] = true;
              const Point<dim> before      = cell->vertex(v);
              cell->vertex(v) += motion->second;
              forest.vertex_has_moved(cell->material_id(), before, cell->vertex(v));
            }
    }
  } // namespace



  std::vector<std::string>
  adjust_start(const Scene &scene, Forest &forest, const MPI_Comm communicator)
  {
    if (scene.general.empty() ||
        scene.general.front().initial_overlap != GeneralContactParameters::Overlap::adjust)
      return {};
    const Solid    solid(scene.bodies, scene.discretisation.degree, forest, communicator);
    const NodeMap  map(solid);
    GeneralContact contact(scene.general.front(), general_contact_input(scene, forest), solid, map);
    std::vector<std::string> names;
    for (const BodyParameters &body : scene.bodies)
      names.push_back(body.name);
    const std::string crossings =
      contact.crossings_at(NodeField(map.n_local()), GeneralContact::inset, names);
    const AdjustedSurfaces adjusted(contact, map, planes_of_symmetry(scene, forest, solid));
    move_vertices(adjusted.motions(), solid, forest);
    const std::string of = "contact pair " + scene.general.front().name + ": ";
    if (adjusted.motions().empty())
      return {of + "nothing overlaps at the start"};
    char text[100];
    std::snprintf(text,
                  sizeof(text),
                  "%zu nodes are moved by up to %.4g, without stress",
                  adjusted.motions().size(),
                  adjusted.largest());
    std::vector<std::string> lines;
    if (!crossings.empty())
      lines.push_back(of + "surfaces cross each other as placed " + crossings);
    lines.push_back(of + text);
    return lines;
  }
} // namespace Touchstone
