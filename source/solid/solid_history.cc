// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/solid/solid.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>

// The history of the materials: in checkpoints, on ghost cells, and what the output shows of it
// (doc/materials.md).
namespace Touchstone
{
  using namespace dealii;

  bool
  Solid::thermal() const
  {
    return std::any_of(bodies.begin(), bodies.end(), [](const BodyParameters &body) {
      return body.material.thermal();
    });
  }



  /** Ranks assemble their ghost cells as well, so history of a cell must be known to all of these.
   * Collective. */
  void
  Solid::save(ArchiveWriter &archive) const
  {
    if (thermal())
      archive.put("material time", committed_time);
    if (has_history())
      archive.put_cells("material", [this](const unsigned int cell) { return cell_state(cell); });
  }



  void
  Solid::load(const ArchiveReader &archive)
  {
    if (thermal())
      {
        committed_time = archive.get<double>("material time");
        set_time(committed_time);
      }
    if (!has_history())
      return;
    const auto &states = archive.cells("material");
    for (unsigned int cell = 0; cell < states.size(); ++cell)
      if (!states[cell].empty())
        set_cell_state(cell, states[cell]);
    // Ghost cells need the history of their owners.
    exchange_cell_states();
  }



  MaterialHistory
  Solid::take_history()
  {
    MaterialHistory result;
    if (has_history())
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
          result[cell->active_cell_index()] = cell_state(cell->active_cell_index());
    nonlinear->keep_in(nullptr);
    set_time(0.);
    committed_time = 0.;
    return result;
  }



  void
  Solid::give_history(const MaterialHistory &history, const double committed)
  {
    for (const auto &[cell, state] : history)
      set_cell_state(cell, state);
    set_time(committed);
    committed_time = committed;
  }



  void
  Solid::exchange_cell_states()
  {
    using Cell = Triangulation<dim>::active_cell_iterator;
    if (has_history())
      GridTools::exchange_cell_data_to_ghosts<std::vector<double>, Triangulation<dim>>(
        dof_handler.get_triangulation(),
        [&](const Cell &cell) -> std_cxx17::optional<std::vector<double>> {
          return cell_state(cell->active_cell_index());
        },
        [&](const Cell &cell, const std::vector<double> &values) {
          set_cell_state(cell->active_cell_index(), values);
        });
  }



  /** Plastic work since the start over all bodies (energy; doc/materials.md, "Output").
   * Collective. */
  double
  Solid::dissipation() const
  {
    double sum = 0.;
    if (!has_history())
      return sum;
    nonlinear->for_each_state(
      [&](const unsigned int body, unsigned int, const double volume, const double *state) {
        sum += volume * history_law(body)->dissipation(state);
      });
    return Utilities::MPI::sum(sum, communicator);
  }



  dealii::Vector<double>
  Solid::cell_plastic_strain() const
  {
    // Means over the reference volumes of the points of each cell.
    const unsigned int     n = dof_handler.get_triangulation().n_active_cells();
    dealii::Vector<double> result(n), volumes(n);
    if (plastic())
      nonlinear->for_each_state([&](const unsigned int body,
                                    const unsigned int cell,
                                    const double       volume,
                                    const double      *state) {
        result(cell) += volume * history_law(body)->plastic_strain(state);
        volumes(cell) += volume;
      });
    for (unsigned int i = 0; i < n; ++i)
      if (volumes(i) > 0.)
        result(i) /= volumes(i);
    return result;
  }



  std::vector<double>
  Solid::point_plastic_strain() const
  {
    if (!plastic())
      return {};
    // Where the points of each cell begin, and how many of them have been visited.
    const std::size_t        n_points = Utilities::pow(fe.degree + 1, dim);
    std::vector<std::size_t> next(dof_handler.get_triangulation().n_active_cells());
    std::size_t              size = 0;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          next[cell->active_cell_index()] = size;
          size += n_points;
        }
    std::vector<double> result(size);
    nonlinear->for_each_state(
      [&](const unsigned int body, const unsigned int cell, double, const double *state) {
        result[next[cell]++] = history_law(body)->plastic_strain(state);
      });
    return result;
  }



  std::map<unsigned int, double>
  Solid::largest_plastic_strain() const
  {
    // Plastic bodies get an entry on all ranks, also those that own none of their cells: the
    // reduction below is collective for each entry.
    std::map<unsigned int, double> result;
    for (unsigned int b = 0; b < bodies.size(); ++b)
      if (const auto law = history_law(b); law && law->plastic())
        result[b] = 0.;
    if (plastic())
      nonlinear->for_each_state(
        [&](const unsigned int body, unsigned int, double, const double *state) {
          if (const auto found = result.find(body); found != result.end())
            found->second = std::max(found->second, history_law(body)->plastic_strain(state));
        });
    for (auto &[body, value] : result)
      value = Utilities::MPI::max(value, communicator);
    return result;
  }
} // namespace Touchstone
