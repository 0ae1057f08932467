// SPDX-License-Identifier: LGPL-2.1-or-later
// The history of the material when the mesh changes: a state that is the same everywhere
// stays what it is through refinement and coarsening; one that is not comes back after
// refinement and coarsening; det Fp = 1 when different states are merged; on any number of
// ranks, ghost cells included.

#include <touchstone/scene/scene.h>
#include <touchstone/solid/state_transfer.h>

#include <deal.II/base/mpi.h>

#include "mesh_common.h"
#include <random>

using namespace Touchstone;
using namespace dealii;

namespace
{
  const std::string text = R"(
set Bodies = elastic, plastic
subsection Body elastic
  subsection Geometry
    set Cells = 2, 2, 2
  end
  subsection Material
    set Young modulus = 1
  end
end
subsection Body plastic
  subsection Geometry
    set Lower corner = 0, 0, 1
    set Upper corner = 1, 1, 2
    set Cells        = 4, 3, 2
  end
  subsection Material
    set Young modulus = 1000
    subsection Plasticity
      set Yield stress      = 2
      set Kinematic modulus = 10
    end
  end
end
)";

  using States = std::map<unsigned int, std::vector<double>>;

  struct Bodies
  {
    const Scene  scene;
    Forest       forest;
    Solid        solid;
    unsigned int n_state;

    Bodies(const std::string &law, const std::string &degree)
      : scene(text,
              "scene.prm",
              {"Discretisation/Partitioner=p4est",
               "Body plastic/Material/Law=" + law,
               "Discretisation/Degree=" + degree})
      , forest(scene.forest_input(), "", MPI_COMM_WORLD)
      , solid(scene.bodies, scene.discretisation.degree, forest, MPI_COMM_WORLD)
      , n_state(solid.history_law(1)->n_state())
    {
    }

    /** Give each point of the plastic body the state that @p make writes. */
    void
    set(const std::function<void(const CellId &, unsigned int, double *)> &make)
    {
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && cell->material_id() == 1)
          {
            auto values = solid.cell_state(cell->active_cell_index());
            for (unsigned int q = 0; q < values.size() / n_state; ++q)
              make(cell->id(), q, &values[q * n_state]);
            solid.set_cell_state(cell->active_cell_index(), values);
          }
      solid.exchange_cell_states();
    }

    void
    change(const bool refine)
    {
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            if (refine && cell->center()[0] < 0.6)
              cell->set_refine_flag();
            else if (!refine && cell->level() > 0)
              cell->set_coarsen_flag();
          }
      forest.triangulation.prepare_coarsening_and_refinement();
      StateTransfer transfer(forest.triangulation, solid);
      forest.triangulation.execute_coarsening_and_refinement();
      solid.reinit();
      transfer.finish();
    }

    /** Largest difference from what @p expected gives, over owned and ghost cells. */
    double
    difference(const std::function<std::vector<double>(const CellId &, unsigned int)> &expected)
    {
      double result = 0.;
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
          {
            const auto values = solid.cell_state(cell->active_cell_index());
            if (cell->is_locally_owned() && values.empty() != (cell->material_id() == 0))
              result = 1.;
            for (unsigned int q = 0; q < values.size() / n_state; ++q)
              {
                const auto exact = expected(cell->id(), q);
                for (unsigned int k = 0; k < n_state; ++k)
                  result = std::max(result, std::abs(values[q * n_state + k] - exact[k]));
              }
          }
      return Utilities::MPI::max(result, MPI_COMM_WORLD);
    }

    double
    determinant_error()
    {
      double result = 0.;
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const auto values = solid.cell_state(cell->active_cell_index());
            for (unsigned int q = 0; q < values.size() / n_state; ++q)
              {
                Tensor<2, dim> inverse;
                for (unsigned int i = 0; i < 9; ++i)
                  inverse[i / 3][i % 3] = values[q * n_state + 2 + i];
                result = std::max(result, std::abs(determinant(inverse) - 1.));
              }
          }
      return Utilities::MPI::max(result, MPI_COMM_WORLD);
    }
  };

  /** A state of the law that is not virgin, by a number. */
  std::vector<double>
  sample(const MaterialLaw &law, const unsigned int seed)
  {
    std::vector<double> state(law.n_state());
    law.start(state.data());
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> random(-0.2, 0.2);
    state[0] = 0.3 + random(generator);
    for (unsigned int k = 1; k < state.size(); ++k)
      state[k] += random(generator);
    law.restore(state.data());
    return state;
  }

  void
  check(const std::string &law_name, const std::string &degree)
  {
    Bodies      bodies(law_name, degree);
    const auto  law = bodies.solid.history_law(1);
    const auto  one = sample(*law, 1);
    const auto &id  = [](const CellId &cell) {
      return static_cast<unsigned int>(cell.to_binary<dim>()[0]);
    };
    bodies.set([&](const CellId &, unsigned int, double *state) {
      std::copy(one.begin(), one.end(), state);
    });
    const auto   same  = [&](const CellId &, unsigned int) { return one; };
    const double work  = bodies.solid.dissipation();
    const auto   cells = bodies.forest.triangulation.n_global_active_cells();
    bodies.change(true);
    const auto   finer      = bodies.forest.triangulation.n_global_active_cells();
    const double refined    = bodies.difference(same);
    const double work_after = bodies.solid.dissipation();
    bodies.change(false);
    const auto   coarser   = bodies.forest.triangulation.n_global_active_cells();
    const double coarsened = bodies.difference(same);

    const auto various = [&](const CellId &cell, const unsigned int q) {
      return sample(*law, 100 * id(cell) + q);
    };
    bodies.set([&](const CellId &cell, const unsigned int q, double *state) {
      const auto values = various(cell, q);
      std::copy(values.begin(), values.end(), state);
    });
    bodies.change(true);
    bodies.change(false);
    const double back        = bodies.difference(various);
    double       determinant = 0.;
    if (law_name[0] == 'f')
      {
        bodies.change(true);
        bodies.set([&](const CellId &cell, const unsigned int q, double *state) {
          const auto values = sample(*law, 777 * id(cell) + q);
          std::copy(values.begin(), values.end(), state);
        });
        bodies.change(false);
        determinant = bodies.determinant_error();
      }
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        std::cout << law_name << ", degree " << degree << ": " << cells << " cells, refined "
                  << finer << ", coarsened " << coarser << "; uniform state "
                  << small(std::max(refined, coarsened), 1e-14) << ", plastic work "
                  << small(work_after / work - 1., 1e-13);
        if (degree == "1")
          std::cout << ", other states come back " << small(back, 1e-14);
        if (law_name[0] == 'f')
          std::cout << ", det Fp - 1 of averages " << small(determinant, 1e-14);
        std::cout << std::endl;
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string law : {"small-strain von Mises", "finite-strain von Mises"})
    for (const std::string degree : {"1", "2"})
      check(law, degree);
  return 0;
}
