// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/explicit/explicit_cells.h>
#include <touchstone/explicit/stable_step.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

// Masses, forces and the stable step of all bodies of an explicit run (doc/explicit.md, sections 4
// and 5).
namespace Touchstone
{
  using namespace dealii;

  std::string
  CellPlace::text(const std::vector<BodyParameters> &bodies) const
  {
    char where[100];
    std::snprintf(where,
                  sizeof(where),
                  "' at (%.4g, %.4g, %.4g)",
                  position[0] + 0.,
                  position[1] + 0.,
                  position[2] + 0.);
    return "body '" + bodies[body].name + where;
  }



  ExplicitCells::ExplicitCells(const NodeMap                     &map,
                               const std::vector<BodyParameters> &bodies,
                               const ExplicitParameters          &parameters)
    : map(map)
    , bodies(bodies)
    , parameters(parameters)
    , factors(bodies.size())
    , periods(bodies.size())
    , nodal_mass(map.n_local())
  {
    std::vector<std::vector<unsigned int>> cells(bodies.size());
    std::vector<std::size_t>               n_cells(bodies.size());
    for (const NodeMap::Cell &cell : map.cells())
      ++n_cells[cell.body];
    for (unsigned int b = 0; b < bodies.size(); ++b)
      cells[b].reserve(n_cells[b]);
    for (unsigned int c = 0; c < map.cells().size(); ++c)
      cells[map.cells()[c].body].push_back(c);
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        of_bodies.push_back(CellForces::make(map, cells[b], bodies[b]));
        for (unsigned int c = 0; c < cells[b].size() && of_bodies[b]->history() != nullptr; ++c)
          {
            const unsigned int number = map.cells()[cells[b][c]].index;
            if (number >= place_of.size())
              place_of.resize(number + 1, {-1, 0});
            place_of[number] = {c, b};
          }
      }
    sum_masses();
  }



  void
  ExplicitCells::sum_masses()
  {
    std::fill(nodal_mass.begin(), nodal_mass.end(), 0.);
    for (unsigned int b = 0; b < bodies.size(); ++b)
      of_bodies[b]->add_masses(factors[b], nodal_mass);
    map.update_ghosts(nodal_mass);
  }



  CellPlace
  ExplicitCells::place(const unsigned int body, const unsigned int c) const
  {
    const unsigned int        number = of_bodies[body]->cell_numbers()[c];
    const NodeMap::CellNodes &nodes  = map.nodes(number);
    CellPlace                 result;
    result.key  = map.cells()[number].key;
    result.body = body;
    for (unsigned int a = 0; a < NodeMap::nodes_per_cell; ++a)
      for (unsigned int d = 0; d < dim; ++d)
        result.position[d] += 0.125 * map.positions()[nodes[a]][d];
    return result;
  }



  CellPlace
  ExplicitCells::first(const CellPlace &mine) const
  {
    CellPlace result = mine;
    for (const auto &others : gather_records(std::vector<CellPlace>{mine}, map.communicator()))
      for (const CellPlace &other : others)
        if (other.key < result.key)
          result = other;
    return result;
  }



  CellPlace
  ExplicitCells::evaluate(const NodeField &u,
                          const NodeField &v,
                          const double     time,
                          const double     step,
                          NodeField       &force,
                          NodeField       &viscous)
  {
    std::fill(force.begin(), force.end(), Tensor<1, dim>());
    std::fill(viscous.begin(), viscous.end(), Tensor<1, dim>());
    const bool damped = parameters.linear_viscosity > 0. || parameters.quadratic_viscosity > 0.;
    CellPlace  failed;
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        const CellForces::BulkViscosity bulk{Viscosity(bodies[b].material, parameters, step),
                                             periods[b]};
        of_bodies[b]->set_time(time);
        const unsigned int c =
          of_bodies[b]->subtract_forces(u, v, step, damped ? &bulk : nullptr, force, viscous);
        if (c != numbers::invalid_unsigned_int)
          if (const CellPlace one = place(b, c); one.key < failed.key)
            failed = one;
      }
    return failed;
  }



  ExplicitCells::Energies
  ExplicitCells::energies(const NodeField &u)
  {
    CellEnergies sum;
    for (const auto &cells : of_bodies)
      cells->add_energies(u, sum);
    return {sum.strain.value(map.communicator()),
            sum.plastic.value(map.communicator()),
            sum.hourglass.value(map.communicator())};
  }



  void
  ExplicitCells::commit()
  {
    for (const auto &cells : of_bodies)
      if (CellStates *const history = cells->history())
        history->commit();
  }



  void
  ExplicitCells::rollback()
  {
    for (const auto &cells : of_bodies)
      if (CellStates *const history = cells->history())
        history->rollback();
  }



  void
  ExplicitCells::forget()
  {
    for (const auto &cells : of_bodies)
      cells->forget();
  }



  std::vector<double>
  ExplicitCells::committed_state(const unsigned int cell) const
  {
    if (cell >= place_of.size() || place_of[cell].first < 0)
      return {};
    return of_bodies[place_of[cell].second]->state(place_of[cell].first);
  }



  void
  ExplicitCells::set_state(const unsigned int cell, const std::vector<double> &values)
  {
    if (cell < place_of.size() && place_of[cell].first >= 0)
      of_bodies[place_of[cell].second]->set_state(place_of[cell].first, values);
  }
} // namespace Touchstone
