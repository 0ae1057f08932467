// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/body_mesh.h>
#include <touchstone/mesh/contact_work.h>
#include <touchstone/mesh/partition.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/distributed/shared_tria.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <cmath>
#include <stdexcept>

#ifdef TOUCHSTONE_WITH_METIS
#  include <metis.h>
#endif

// Three ways of distributing the mesh, apart from that by coordinates (bisection.cc): the whole
// mesh on one rank, the space-filling curve of p4est, which alone can adapt the mesh, and METIS,
// which minimises the faces between parts.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
#ifdef TOUCHSTONE_WITH_METIS
    /** Set the subdomain ids of a serial triangulation. @return Whether METIS could. */
    bool
    set_subdomains(Triangulation<dim> &triangulation,
                   const unsigned int  n_ranks,
                   const CellWork     &cell_work,
                   const CellWork     &contact_work,
                   const bool          balance_contact)
    {
      // METIS does not want connections of a cell with itself, which the pattern has.
      DynamicSparsityPattern connected;
      GridTools::get_face_connectivity_of_cells(triangulation, connected);
      // The graph in the compressed row format of METIS: neighbours of cell c are those from
      // first[c] to first[c + 1].
      std::vector<idx_t> first(1, 0), neighbours;
      for (unsigned int c = 0; c < connected.n_rows(); ++c)
        {
          for (auto entry = connected.begin(c); entry != connected.end(c); ++entry)
            if (entry->column() != c)
              neighbours.push_back(entry->column());
          first.push_back(neighbours.size());
        }

      bool any = false;
      for (const auto &cell : triangulation.active_cell_iterators())
        any = any || (balance_contact && contact_work(cell) > 0);
      // Without any weight in it a constraint cannot be met.
      idx_t n_constraints = any ? 2 : 1;
      // Two weights per cell, its own work and that of contact, which METIS balances as separate
      // constraints: ranks wait for each other in assembly and in contact search alike.
      std::vector<idx_t> weights;
      for (const auto &cell : triangulation.active_cell_iterators())
        {
          weights.push_back(cell_work(cell));
          if (any)
            weights.push_back(contact_work(cell));
        }

      idx_t options[METIS_NOPTIONS];
      METIS_SetDefaultOptions(options);
      // A fixed seed makes runs reproducible.
      options[METIS_OPTION_SEED] = 1;
      // Largest piece over the mean: contact comes in larger lumps.
      std::vector<real_t> tolerances{1.03, 1.1};
      idx_t               n_cells = connected.n_rows(), n_parts = n_ranks, n_cut = 0;
      std::vector<idx_t>  part(n_cells, 0);
      // METIS refuses to make one part of several.
      if (n_ranks > 1 && METIS_PartGraphKway(&n_cells,
                                             &n_constraints,
                                             first.data(),
                                             neighbours.data(),
                                             weights.data(),
                                             nullptr,
                                             nullptr,
                                             &n_parts,
                                             nullptr,
                                             tolerances.data(),
                                             options,
                                             &n_cut,
                                             part.data()) != METIS_OK)
        return false;
      for (const auto &cell : triangulation.active_cell_iterators())
        cell->set_subdomain_id(part[cell->active_cell_index()]);
      return true;
    }
#else
    bool
    set_subdomains(Triangulation<dim> &,
                   const unsigned int,
                   const CellWork &,
                   const CellWork &,
                   const bool)
    {
      return false;
    }
#endif
  } // namespace



  std::unique_ptr<parallel::TriangulationBase<dim>>
  whole_mesh(const BodyMesh &mesh, const unsigned int refinements, const MPI_Comm communicator)
  {
    using Mesh = parallel::shared::Triangulation<dim>;
    // On one rank there are no artificial cells, but functions that exchange data with ghost cells
    // ask for the kind of mesh that could have them.
    auto triangulation = std::make_unique<Mesh>(communicator,
                                                Mesh::limit_level_difference_at_vertices,
                                                /*allow_artificial_cells=*/true,
                                                Mesh::partition_zorder);
    create_triangulation(mesh, *triangulation);
    triangulation->refine_global(refinements);
    return triangulation;
  }



  std::unique_ptr<parallel::TriangulationBase<dim>>
  partition_by_curve(const BodyMesh    &mesh,
                     const unsigned int refinements,
                     const CellWork    &cell_work,
                     const CellWork    &contact_work,
                     const bool         weighted,
                     const double       contact_weight,
                     const MPI_Comm     communicator)
  {
    using Mesh = parallel::distributed::Triangulation<dim>;
    // Cells and unknowns are numbered by the mesh alone, and not by how it came about:
    // a run that resumes from a checkpoint makes the same mesh in other steps.
    auto triangulation = std::make_unique<Mesh>(communicator,
                                                Mesh::limit_level_difference_at_vertices,
                                                Mesh::mesh_reconstruction_after_repartitioning);
    create_triangulation(mesh, *triangulation);
    triangulation->refine_global(refinements);
    if (weighted)
      {
        // Weights are whole numbers: in thousandths of the least work of a cell.
        const double unit = 1000. * contact_weight / ContactWork::slave_face;
        triangulation->signals.weight.connect(
          [=](const Mesh::cell_iterator &cell, const Mesh::CellStatus status) {
            // For each child of a cell that is refined this asks for the parent, whose
            // face only every other child has.
            const bool   there = (status == Mesh::CELL_PERSIST || status == Mesh::CELL_COARSEN);
            const double share = there ? 1. : 0.5;
            return 1000u * cell_work(cell) +
                   static_cast<unsigned int>(std::lround(share * unit * contact_work(cell)));
          });
        triangulation->repartition();
      }
    return triangulation;
  }



  /** One rank of each group makes the whole refined mesh, calls METIS and sends the others their
   * parts; with a single group of all ranks that is the first rank. Memory for the whole mesh is
   * needed there. Collective. */
  std::unique_ptr<parallel::TriangulationBase<dim>>
  partition_by_graph(const BodyMesh    &mesh,
                     const unsigned int refinements,
                     const CellWork    &cell_work,
                     const CellWork    &contact_work,
                     const bool         balance_contact,
                     const MPI_Comm     communicator)
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    // Of the first rank; the exception is thrown after all ranks have been told, as they would wait
    // for ever otherwise.
    int        failed = 0;
    const auto description =
      TriangulationDescription::Utilities::create_description_from_triangulation_in_groups<dim,
                                                                                           dim>(
        [&](Triangulation<dim> &all) {
          create_triangulation(mesh, all);
          all.refine_global(refinements);
        },
        [&](Triangulation<dim> &all, const MPI_Comm &, const unsigned int) {
          failed = !set_subdomains(all, n_ranks, cell_work, contact_work, balance_contact);
        },
        communicator,
        n_ranks,
        Triangulation<dim>::limit_level_difference_at_vertices);
    if (Utilities::MPI::max(failed, communicator) != 0)
      throw std::runtime_error("METIS cannot partition the mesh for " + std::to_string(n_ranks) +
                               " ranks: set 'Discretisation/Partitioner = p4est'");

    auto triangulation =
      std::make_unique<parallel::fullydistributed::Triangulation<dim>>(communicator);
    for (const auto &[id, manifold] : mesh.manifolds)
      triangulation->set_manifold(id, *manifold);
    triangulation->create_triangulation(description);
    return triangulation;
  }
} // namespace Touchstone
