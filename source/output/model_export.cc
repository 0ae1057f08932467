// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/folder.h>
#include <touchstone/base/input_error.h>
#include <touchstone/contact/friction/friction_law.h>
#include <touchstone/contact/geometry/surface.h>
#include <touchstone/output/json.h>
#include <touchstone/output/model_export.h>
#include <touchstone/solid/boundary_conditions.h>

#include <cmath>

/**
 * @file
 * Option --export-model: mesh, supports, loads and contact surfaces as JSON, for comparison with
 * other programs. Nodes are numbered as in the solver (dof / 3), so that results can be compared
 * node by node. One rank only: the numbering of several would depend on the partition.
 */

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /**
     * For each node of a cell in lexicographic order the index of its first dof within the cell:
     * deal.II numbers vertices first, then lines, faces and the interior, an order that other
     * programs do not share.
     */
    std::vector<unsigned int>
    lexicographic_nodes(const FiniteElement<dim> &fe)
    {
      const unsigned int        n = fe.degree + 1;
      std::vector<unsigned int> result(n * n * n);
      for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
        if (fe.system_to_component_index(i).first == 0)
          {
            // Lexicographic index of the support point, x fastest: its coordinates in the unit cell
            // are multiples of 1/degree.
            unsigned int position = 0;
            for (unsigned int d = dim; d-- > 0;)
              position = n * position + static_cast<unsigned int>(
                                          std::lround(fe.unit_support_point(i)[d] * fe.degree));
            result[position] = i;
          }
      return result;
    }



    /** Reference positions of all nodes, and the cells of each body as lists of nodes. */
    void
    export_mesh(const Scene &scene, const Solid &solid, Json &model)
    {
      const std::vector<unsigned int> order = lexicographic_nodes(solid.fe);
      std::vector<Point<dim>>         nodes(solid.dof_handler.n_dofs() / dim);
      std::vector<Json>               cells(scene.bodies.size(), Json::array());
      std::vector<Index>              dofs(solid.fe.n_dofs_per_cell());
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        {
          cell->get_dof_indices(dofs);
          Json list = Json::array();
          for (const unsigned int i : order)
            {
              nodes[dofs[i] / dim] =
                solid.mapping.transform_unit_to_real_cell(cell, solid.fe.unit_support_point(i));
              list.append(dofs[i] / dim);
            }
          cells[cell->material_id()].append(list);
        }

      Json positions = Json::array();
      for (const Point<dim> &x : nodes)
        positions.append(Tensor<1, dim>(x));
      model.set("nodes", positions);
      Json bodies = Json::array();
      for (unsigned int b = 0; b < scene.bodies.size(); ++b)
        {
          const BodyParameters &body = scene.bodies[b];
          bodies.append(Json::object()
                          .set("name", body.name)
                          .set("element", body.element_type.word())
                          .set("law", body.material.law.name)
                          .set("young_modulus", body.material.young_modulus)
                          .set("poisson_ratio", body.material.poisson_ratio)
                          .set("cells", cells[b]));
        }
      model.set("bodies", bodies);
    }



    /**
     * The faces of the named boundaries as lists of nodes; without the exact geometry, for the
     * other program has none.
     */
    Json
    export_faces(const Scene                    &scene,
                 const Forest                   &forest,
                 const Solid                    &solid,
                 const std::string              &body_name,
                 const std::vector<std::string> &boundaries,
                 const std::string              &section,
                 const std::string              &key)
    {
      const unsigned int body = scene.body_index(body_name);
      const BoundaryIds  ids  = forest.boundary_ids(body, boundaries, section, key);
      // Surface gives faces their nodes in the orientation that contact uses: axes whose cross
      // product points outward.
      const Surface surface(solid, forest, body, ids, /*exact=*/false);
      Json          list = Json::array();
      for (const Face &face : surface.owned_faces())
        {
          Json nodes = Json::array();
          for (unsigned int m = 0; m < face.n_nodes(); ++m)
            nodes.append(face.nodes[m]);
          list.append(nodes);
        }
      return list;
    }



    /**
     * Contact pairs with their coefficient of friction: the slope of the law's limit at a sliding
     * node of unit force and area: mu of Coulomb's law.
     */
    Json
    export_pairs(const Scene &scene, const Forest &forest, const Solid &solid)
    {
      Json pairs = Json::array();
      for (const ContactPairParameters &pair : scene.pairs)
        {
          FrictionInput input;
          input.normal_force = 1.;
          input.area         = 1.;
          input.sliding      = true;
          const auto faces   = [&](const auto &body, const auto &boundaries, const auto &key) {
            return export_faces(scene, forest, solid, body, boundaries, pair.section(), key);
          };
          pairs.append(
            Json::object()
              .set("name", pair.name)
              .set("behaviour", pair.behaviour.name)
              .set("friction_coefficient", pair.friction ? pair.friction->limit(input).slope : 0.)
              .set("slave", faces(pair.slave_body, pair.slave_boundaries, "Slave boundaries"))
              .set("master",
                   pair.obstacle.empty()
                     ? faces(pair.master_body, pair.master_boundaries, "Master boundaries")
                     : Json::array()));
        }
      return pairs;
    }



    /**
     * A row [node, x, y, z]. Components below 1e-14 of @p scale are round-off, which would differ
     * between machines, and become zero.
     */
    Json
    node_entry(const Index node, const Tensor<1, dim> &vector, const double scale)
    {
      Json entry = Json::array().append(node);
      for (unsigned int d = 0; d < dim; ++d)
        entry.append(std::abs(vector[d]) > 1e-14 * scale ? vector[d] : 0.);
      return entry;
    }



    /** Conditions and loads at the end of a step. */
    Json
    export_step(const BoundaryConditions &conditions, const Solid &solid, const double time)
    {
      // Prescribed displacements by the support that they belong to.
      std::map<std::string, Json> lists;
      for (const PrescribedDisplacement &p : conditions.displacements(time))
        lists.emplace(p.support, Json::array())
          .first->second.append(node_entry(p.node, p.direction, 1.).append(p.value));
      Json displacements = Json::object();
      for (const auto &[support, list] : lists)
        displacements.set(support, list);

      Vector force(solid.zero_vector());
      // Loads of the reference configuration (zero displacement): for pressure that follows the
      // surface, doc/theory.md 2.3, the other program has to do that itself.
      conditions.external_force(time, solid.zero_vector(), force);
      // Scale of round-off of the nodal forces: loads that cancel at a node leave digits that are
      // no load.
      const double largest = force.linfty_norm();
      Json         forces  = Json::array();
      for (Index node = 0; node < solid.dof_handler.n_dofs() / dim; ++node)
        {
          Tensor<1, dim> f;
          for (unsigned int d = 0; d < dim; ++d)
            f[d] = force(dim * node + d);
          if (f.norm() > 1e-14 * largest)
            forces.append(node_entry(node, f, largest));
        }
      return Json::object()
        .set("time", time)
        .set("displacements", displacements)
        .set("forces", forces);
    }
  } // namespace



  void
  export_model(const Scene       &scene,
               const std::string &folder_of_scene,
               const std::string &path,
               const MPI_Comm     communicator)
  {
    if (Utilities::MPI::n_mpi_processes(communicator) > 1)
      throw InputError("command line",
                       "--export-model",
                       path,
                       "a model is exported by one rank",
                       "start touchstone without mpirun");
    const Forest             forest(scene.forest_input(), folder_of_scene, communicator);
    const Solid              solid(scene.bodies, scene.discretisation.degree, forest, communicator);
    const BoundaryConditions conditions(forest, solid);

    Json model = Json::object();
    model.set("title", scene.title)
      .set("degree", scene.discretisation.degree)
      .set("reference",
           Json::object()
             .set("type", scene.reference.type.name)
             .set("pair", scene.reference.pair)
             .set("values", scene.reference.values));
    export_mesh(scene, solid, model);
    model.set("pairs", export_pairs(scene, forest, solid));
    Json steps = Json::array();
    for (const double end : scene.load_stepping.step_ends())
      steps.append(export_step(conditions, solid, end));
    model.set("steps", steps);
    // Sixteen digits: mesh and loads are to be the same numbers there.
    write_file_atomically(path, model.print(16));
  }
} // namespace Touchstone
