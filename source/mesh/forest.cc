// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/body_mesh.h>
#include <touchstone/mesh/connection.h>
#include <touchstone/mesh/contact_work.h>
#include <touchstone/mesh/forest.h>
#include <touchstone/mesh/hanging_vertices.h>
#include <touchstone/mesh/partition.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/tria.h>

#include <cmath>
#include <set>

// The mesh of all bodies as one triangulation: coarse meshes are made by their geometries, joined
// without common vertices, partitioned and refined. Boundaries get ids that are unique over all
// bodies.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Refuse cells that would make the stiffness meaningless. */
    void
    check_cells(const BodyMesh &mesh, const std::string &section)
    {
      const Orientation cells = orientation(mesh);
      if (cells.negative + cells.distorted > 0)
        throw InputError(section,
                         "",
                         "",
                         std::to_string(cells.negative + cells.distorted) + " of " +
                           std::to_string(mesh.cells.size()) + " cells are inverted or distorted",
                         "use more cells, or a geometry with blunter corners");
    }



    /** The coarse mesh of a body. */
    BodyMesh
    create(const Geometry    &geometry,
           const double       factor,
           const std::string &section,
           const std::string &folder)
    {
      try
        {
          return geometry.create(factor, section, folder);
        }
      catch (const TooManyCells &error)
        {
          throw InputError(section, "Cells", "", error.what(), "ask for fewer cells");
        }
    }



    /** Refuse a mesh that would have too many cells when it is refined. */
    void
    check_refined(const std::size_t               cells,
                  const unsigned int              level,
                  const DiscretisationParameters &parameters)
    {
      // Counted in cells of degree 1: a cell of degree 2 has about eight times as many dofs, and
      // each refinement eight times the cells.
      try
        {
          check_number_of_cells(cells * std::pow(8., level) * std::pow(parameters.degree, 3));
        }
      catch (const TooManyCells &error)
        {
          throw InputError("Discretisation",
                           "Refinement factor",
                           Patterns::Tools::to_string(parameters.refinement_factor),
                           std::string(error.what()) + " (those of degree 2 count as 8)",
                           "ask for fewer cells");
        }
    }



    /** Append @p body to @p all with ids that are not in use there yet.
     * @return Boundary ids of the body's own ones. */
    std::map<types::boundary_id, types::boundary_id>
    append(const BodyMesh &body, const unsigned int number, BodyMesh &all)
    {
      const unsigned int       first_vertex   = all.vertices.size();
      const types::manifold_id first_manifold = all.manifolds.size();
      types::boundary_id       next_boundary  = 0;
      for (const CellData<2> &face : all.subcells.boundary_quads)
        next_boundary = std::max(next_boundary, face.boundary_id + 1);

      // Geometries number boundaries and manifolds from zero each; here they are moved behind
      // those in use. The body is kept as the material id of its cells.
      std::map<types::manifold_id, types::manifold_id> manifold_ids;
      for (const auto &[id, manifold] : body.manifolds)
        {
          manifold_ids[id]                = first_manifold + manifold_ids.size();
          all.manifolds[manifold_ids[id]] = manifold;
        }
      manifold_ids[numbers::flat_manifold_id] = numbers::flat_manifold_id;

      std::map<types::boundary_id, types::boundary_id> boundary_ids;
      for (const CellData<2> &face : body.subcells.boundary_quads)
        boundary_ids[face.boundary_id] = 0;
      for (auto &[own, id] : boundary_ids)
        id = next_boundary++;

      all.vertices.insert(all.vertices.end(), body.vertices.begin(), body.vertices.end());
      for (CellData<3> cell : body.cells)
        {
          for (unsigned int &v : cell.vertices)
            v += first_vertex;
          cell.material_id = number;
          cell.manifold_id = manifold_ids.at(cell.manifold_id);
          all.cells.push_back(cell);
        }
      for (CellData<2> face : body.subcells.boundary_quads)
        {
          for (unsigned int &v : face.vertices)
            v += first_vertex;
          face.boundary_id = boundary_ids.at(face.boundary_id);
          face.manifold_id = manifold_ids.at(face.manifold_id);
          all.subcells.boundary_quads.push_back(face);
        }
      return boundary_ids;
    }
  } // namespace



  Forest::Forest(const ForestInput &input, const std::string &scene_folder, MPI_Comm communicator)
    : mesh(make(input, scene_folder, communicator))
    , triangulation(*mesh)
  {
    using Refinable = parallel::distributed::Triangulation<dim>;
    if (auto *const refinable = dynamic_cast<Refinable *>(mesh.get());
        refinable != nullptr && input.refines && input.discretisation.degree == 1)
      keep_hanging_vertices(*refinable);
  }



  std::unique_ptr<parallel::TriangulationBase<dim>>
  Forest::make(const ForestInput &input,
               const std::string &scene_folder,
               const MPI_Comm     communicator)
  {
    // Whole powers of two are left to the manifolds, which refine any mesh.
    double factor = input.discretisation.refinement_factor;
    for (; factor >= 2.; factor /= 2.)
      ++level;

    BodyMesh          all;
    std::vector<bool> has_middle_nodes;
    for (unsigned int body = 0; body < input.bodies.size(); ++body)
      {
        // Errors of a geometry are reported with the section of its body, since geometries do not
        // know for whom they work.
        const std::string section = "Body " + input.bodies[body].name + "/Geometry";

        const BodyMesh mesh = create(*input.bodies[body].geometry, factor, section, scene_folder);
        check_cells(mesh, section);
        if (const std::string text = check_connection(mesh, input, body, section); !text.empty())
          notices.push_back(text);
        if (mesh.bulge > 0. && level == 0 && input.discretisation.degree == 1)
          notices.push_back(
            "The nodes in the middle of edges and faces of the mesh of body '" +
            input.bodies[body].name + "' lie up to " + Patterns::Tools::to_string(mesh.bulge) +
            " beside straight cells, and elements of degree 1 do not have them: the "
            "body has straight edges. Use 'Discretisation/Degree = 2', or a "
            "'Refinement factor' of 2, whose new nodes they are.");
        has_middle_nodes.push_back(mesh.bulge > 0.);
        const auto ids = append(mesh, body, all);

        add_boundaries(mesh, ids, input.bodies[body].symmetry);
      }
    check_refined(all.cells.size(), level, input.discretisation);

    // Work per cell and per contact face, by which parts are balanced. Bodies of equal work count
    // by one, so that partitions do not depend on the law that all have in common.
    const auto contact_work = std::make_shared<ContactWork>();
    for (const ForestInput::Pair &pair : input.pairs)
      {
        const BoundaryIds slaves  = boundary_ids(pair.slave_body,
                                                pair.slave_boundaries,
                                                pair.section,
                                                "Slave boundaries"),
                          masters = boundary_ids(pair.master_body,
                                                 pair.master_boundaries,
                                                 pair.section,
                                                 "Master boundaries");
        contact_work->add_pair(all, slaves, masters);
        if (pair.takes_facets && !has_middle_nodes[pair.slave_body])
          notice_facets(all, slaves, input.bodies[pair.slave_body].name, pair.section);
        if (pair.takes_facets && !has_middle_nodes[pair.master_body])
          notice_facets(all, masters, input.bodies[pair.master_body].name, pair.section);
      }
    const CellWork work = [contact_work](const Triangulation<dim>::cell_iterator &cell) {
      return (*contact_work)(cell);
    };
    std::vector<unsigned int> work_of_body;
    for (const ForestInput::Body &body : input.bodies)
      work_of_body.push_back(body.work);
    const bool alike = std::set<unsigned int>(work_of_body.begin(), work_of_body.end()).size() == 1;
    if (alike)
      work_of_body.assign(work_of_body.size(), 1);
    const CellWork cell_work = [work_of_body](const Triangulation<dim>::cell_iterator &cell) {
      return work_of_body[cell->material_id()];
    };
    const DiscretisationParameters &parameters = input.discretisation;
    using Partitioner                          = DiscretisationParameters::Partitioner;
    // Only p4est can change a mesh while it is distributed; meshes that stay are cut by
    // coordinates, into parts of equal work. On one rank there is nothing to cut.
    const Partitioner partitioner = parameters.partitioner != Partitioner::automatic
                                      ? Partitioner(parameters.partitioner)
                                    : input.refines ? Partitioner::p4est
                                                    : Partitioner::coordinates;
    if (partitioner != Partitioner::p4est && Utilities::MPI::n_mpi_processes(communicator) == 1)
      return whole_mesh(all, level, communicator);
    if (partitioner == Partitioner::coordinates)
      return partition_by_coordinates(all,
                                      level,
                                      cell_work,
                                      work,
                                      parameters.contact_weight,
                                      input.computes_ghosts,
                                      communicator);
    if (partitioner != Partitioner::p4est)
      return partition_by_graph(
        all, level, cell_work, work, partitioner == Partitioner::metis, communicator);
    has_weights = parameters.contact_weight > 0. || !alike;
    return partition_by_curve(
      all, level, cell_work, work, has_weights, parameters.contact_weight, communicator);
  }



  /** Refine to a mesh that the run had before, level by level: marked are the cells that have
   * children in that mesh, and their children may be marked in turn once they exist. Collective. */
  void
  Forest::refine(const std::set<CellId::binary_type> &cells)
  {
    for (bool any = true; any;)
      {
        int marked = 0;
        for (const auto &cell : triangulation.active_cell_iterators())
          if (cell->is_locally_owned() && cells.count(cell->id().to_binary<dim>()) > 0)
            {
              cell->set_refine_flag();
              marked = 1;
            }
        any = Utilities::MPI::max(marked, triangulation.get_communicator()) == 1;
        if (any)
          triangulation.execute_coarsening_and_refinement();
      }
    if (weighted())
      repartition();
  }



  void
  Forest::repartition()
  {
    dynamic_cast<parallel::distributed::Triangulation<dim> &>(triangulation).repartition();
  }
} // namespace Touchstone
