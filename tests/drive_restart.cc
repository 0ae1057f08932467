// SPDX-License-Identifier: LGPL-2.1-or-later
// A run that is stopped and goes on with another program of another partition: fields and
// cell data come back exactly where they were, and the steps that follow are the same, for
// each enforcement. In the same partition they are the same to the last bit, and saving again what
// was loaded gives the same bytes.

#include <touchstone/archive/archive.h>

#include <deal.II/numerics/vector_tools_interpolate.h>

#include "drive_support.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** Pieces of all ranks, as a checkpoint would have them on disk. */
  std::vector<std::vector<char>>
  all_pieces(const ArchiveWriter &writer)
  {
    return Utilities::MPI::all_gather(MPI_COMM_WORLD, writer.piece());
  }

  ArchiveReader
  reader(const std::vector<std::vector<char>> &pieces)
  {
    return ArchiveReader([&pieces](const unsigned int i) { return pieces[i]; }, pieces.size());
  }

  Touchstone::Vector
  positions(const Solid &solid)
  {
    Touchstone::Vector result(solid.owned, solid.communicator);
    VectorTools::get_position_vector(solid.mapping, solid.dof_handler, result);
    return result;
  }

  /** Made up, and of another length in each body. */
  std::vector<double>
  cell_values(const typename DoFHandler<dim>::active_cell_iterator &cell)
  {
    std::vector<double> values(2 + 3 * cell->material_id(), 1. / 3. + cell->level());
    values.front() = cell->center().norm();
    return values;
  }

  /** Refine some cells, in two sweeps. */
  void
  refine(Forest &forest, Solid &solid)
  {
    for (unsigned int sweep = 0; sweep < 2; ++sweep)
      {
        for (const auto &cell : forest.triangulation.active_cell_iterators())
          if (cell->is_locally_owned() && cell->center()[0] < 0.5 && cell->material_id() == 0)
            cell->set_refine_flag();
        forest.triangulation.execute_coarsening_and_refinement();
      }
    solid.reinit();
  }

  void
  fields_and_cells(const std::string &from, const std::string &to, const bool refined)
  {
    const Scene scene(blocks, "scene.prm", {"Discretisation/Degree=2", "Discretisation/" + from}),
      other(blocks, "scene.prm", {"Discretisation/Degree=2", "Discretisation/" + to});
    Forest forest(scene.forest_input(), "", MPI_COMM_WORLD),
      other_forest(other.forest_input(), "", MPI_COMM_WORLD);
    Solid solid(scene.bodies, scene.discretisation.degree, forest, MPI_COMM_WORLD);
    if (refined)
      refine(forest, solid);
    const Touchstone::Vector x = positions(solid);
    ArchiveWriter            writer(solid.dof_handler);
    writer.put("number", 0.1);
    writer.put_field("positions", x);
    std::vector<std::vector<double>> values(forest.triangulation.n_active_cells());
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        values[cell->active_cell_index()] = cell_values(cell);
    writer.put_cells("made up", [&](const unsigned int cell) { return values[cell]; });
    // A node of each rank knows all unknowns' first and last node.
    NodeRecord record;
    record.node  = solid.owned.nth_index_in_set(0) / dim;
    record.nodes = {0, solid.dof_handler.n_dofs() / dim - 1};
    record.keys  = {~std::uint64_t(0)};
    writer.put_nodes("far", {record});
    const auto pieces  = all_pieces(writer);
    auto       archive = reader(pieces);

    other_forest.refine(archive.refined_cells(other_forest.first_level()));
    Solid other_solid(other.bodies, other.discretisation.degree, other_forest, MPI_COMM_WORLD);
    archive.connect(other_solid.dof_handler);
    Touchstone::Vector difference = positions(other_solid);
    difference -= archive.field("positions");
    bool         same = archive.get<double>("number") == 0.1;
    unsigned int n    = 0;
    for (const auto &cell : other_solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          same = same && archive.cells("made up")[cell->active_cell_index()] == cell_values(cell);
          ++n;
        }
    n                    = Utilities::MPI::sum(n, MPI_COMM_WORLD);
    same                 = Utilities::MPI::min(int(same), MPI_COMM_WORLD) == 1;
    unsigned int records = 0, keys = 0;
    for (const auto &[node, found] : archive.nodes("far"))
      {
        records += found.nodes.size();
        keys += (found.keys == record.keys);
      }
    const bool in_place = difference.linfty_norm() == 0.;
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << from << " to " << to << (refined ? ", refined" : "") << ": "
                << (in_place ? "positions" : "OTHER POSITIONS") << " and cell data of "
                << (n == forest.triangulation.n_global_active_cells() ? "all" : "SOME") << " cells "
                << (same ? "exact" : "DIFFERENT");
    records = Utilities::MPI::sum(records, MPI_COMM_WORLD);
    keys    = Utilities::MPI::sum(keys, MPI_COMM_WORLD);
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << ", references "
                << (records == 2 * pieces.size() && keys == pieces.size() ? "found" : "LOST")
                << std::endl;
  }

  /** Figures of a state that do not depend on the partition. */
  std::vector<double>
  figures(const Run &run)
  {
    const Touchstone::Vector &u      = run.problem.state().displacement;
    std::vector<double>       result = {u.l2_norm(), run.problem.state().strain_energy()};
    for (const PairResult &pair :
         pair_results(run.problem.state().contact, run.problem.state().ghosted_displacement()))
      result.insert(result.end(),
                    {pair.force[0],
                     pair.force[1],
                     pair.force[2],
                     pair.moment[0],
                     pair.moment[1],
                     pair.moment[2],
                     pair.friction_work,
                     double(pair.active),
                     double(pair.slip)});
    const Energies &energies = run.problem.state().time_integration.committed_energies();
    result.insert(result.end(),
                  {energies.kinetic,
                   energies.plastic,
                   energies.contact,
                   energies.friction,
                   energies.damping,
                   energies.external,
                   energies.initial,
                   energies.largest});
    return result;
  }

  void
  steps(Run &run, const unsigned int first, const unsigned int end)
  {
    for (unsigned int step = first; step < end; ++step)
      {
        run.solve(run.scene.newton, 0.25 * (step + 1));
        run.problem.commit();
      }
  }

  void
  go_on(const std::string       &title,
        std::vector<std::string> overrides,
        const std::string       &scene = blocks)
  {
    overrides.insert(overrides.end(),
                     {"Newton/Residual tolerance=1e-12", "Newton/Gap tolerance=1e-12"});
    Run whole(scene, overrides, MPI_COMM_WORLD);
    steps(whole, 0, 4);
    ArchiveWriter writer(whole.solid.dof_handler);
    whole.problem.save(writer);
    const auto pieces = all_pieces(writer);
    steps(whole, 4, 6);

    bool bytes = false, bits = false;
    {
      Run  again(scene, overrides, MPI_COMM_WORLD);
      auto archive = reader(pieces);
      archive.connect(again.solid.dof_handler);
      again.problem.load(archive);
      ArchiveWriter second(again.solid.dof_handler);
      again.problem.save(second);
      bytes = all_pieces(second) == pieces;
      steps(again, 4, 6);
      const auto &u = again.problem.state().displacement, &v = whole.problem.state().displacement;
      bits = std::equal(u.begin(), u.end(), v.begin(), v.end());
      bits = Utilities::MPI::min(int(bits), MPI_COMM_WORLD) == 1;
    }
    overrides.push_back("Discretisation/Contact weight=50");
    Run  other(scene, overrides, MPI_COMM_WORLD);
    auto archive = reader(pieces);
    archive.connect(other.solid.dof_handler);
    other.problem.load(archive);
    steps(other, 4, 6);
    const auto a = figures(whole), b = figures(other);
    double     difference = 0., size = 0.;
    for (std::size_t i = 0; i < a.size(); ++i)
      {
        difference = std::max(difference, std::abs(a[i] - b[i]));
        size       = std::max(size, std::abs(a[i]));
      }
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        std::cout << title << ": saved again " << (bytes ? "the same bytes" : "OTHER BYTES")
                  << ", then " << (bits ? "the same bits" : "OTHER BITS");
        print_agreement(difference / size, 1e-10);
      }
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  fields_and_cells("Contact weight=0", "Contact weight=50", false);
  fields_and_cells("Contact weight=0", "Contact weight=50", true);
  fields_and_cells("Partitioner=METIS", "Partitioner=METIS, cells only", false);
  for (const std::string enforcement :
       {"elimination", "lagrange multipliers", "augmented lagrange", "penalty"})
    for (const std::string pairing : {"averaged", "pointwise"})
      go_on(enforcement + ", " + pairing,
            {"Contact/Enforcement=" + enforcement, "Contact pair contact/Pairing=" + pairing});
  go_on("regularised", {"Contact/Friction=regularised"});
  go_on("small sliding", {"Contact pair contact/Sliding=small"});
  const std::size_t friction = blocks.find("  set Behaviour");
  go_on("without friction", {}, blocks.substr(0, friction) + "end\n");
  go_on("finite strain", {"Body block/Material/Law=neo-Hookean"});
  go_on("plasticity",
        {"Body base/Material/Law=small-strain von Mises",
         "Body base/Material/Plasticity/Yield stress=5",
         "Body block/Material/Law=finite-strain von Mises",
         "Body block/Material/Plasticity/Yield stress=10",
         "Body block/Material/Plasticity/Kinematic modulus=10"});
  go_on("inertia",
        {"Time integration/Scheme=generalized_alpha",
         "Body base/Material/Density=1",
         "Body block/Material/Density=1",
         "Body block/Material/Rayleigh stiffness=1e-3"});
  go_on("Belos GMRES", {"Linear solver/Type=Belos GMRES"});
  return 0;
}
