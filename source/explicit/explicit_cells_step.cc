// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/base/input_error.h>
#include <touchstone/explicit/explicit_cells.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

// The stable step of all cells and mass scaling (doc/explicit.md, section 4).
namespace Touchstone
{
  using namespace dealii;

  void
  ExplicitCells::update_periods(const NodeField &u)
  {
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        of_bodies[b]->square_frequencies(u, periods[b]);
        for (unsigned int c = 0; c < periods[b].size(); ++c)
          periods[b][c] = std::sqrt((factors[b].empty() ? 1. : factors[b][c]) / periods[b][c]);
      }
  }



  std::vector<double>
  ExplicitCells::steps_of(const unsigned int body, const NodeField &u, const NodeField &v) const
  {
    // Viscous forces are those of the velocity half a cycle before: the step of a mode with the
    // part xi of critical damping (doc/explicit.md, section 4).
    std::vector<double> result(periods[body].size(), 0.);
    if (parameters.quadratic_viscosity > 0.)
      of_bodies[body]->set_volume_rates(u, v, result);
    const Viscosity viscosity(bodies[body].material, parameters, 0.);
    for (unsigned int c = 0; c < result.size(); ++c)
      {
        const double xi = viscosity.damping(result[c], periods[body][c]);
        result[c]       = 2. * periods[body][c] * (std::sqrt(1. + xi * xi) - xi);
      }
    return result;
  }



  StableStep
  ExplicitCells::stable_step(const NodeField &u, const NodeField &v)
  {
    update_periods(u);
    // Of cells that are equal but for round-off the first is named, whatever the processor.
    constexpr double                 same = 1. + 1e-9;
    StableStep                       result;
    std::vector<std::vector<double>> steps(bodies.size());
    result.length = std::numeric_limits<double>::max();
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        steps[b] = steps_of(b, u, v);
        for (const double step : steps[b])
          result.length = std::min(result.length, step);
      }
    result.length = Utilities::MPI::min(result.length, map.communicator());
    for (unsigned int b = 0; b < bodies.size(); ++b)
      for (unsigned int c = 0; c < steps[b].size(); ++c)
        if (steps[b][c] <= same * result.length && place(b, c).key < result.cell.key)
          result.cell = place(b, c);
    result.cell  = first(result.cell);
    result.holds = time_to_shorten(result.length, u, v);
    return result;
  }



  // How long it takes until a cell needs a step that is well below the present one, if its edges go
  // on to change as they do.
  double
  ExplicitCells::time_to_shorten(const double step, const NodeField &u, const NodeField &v) const
  {
    // A little above the stable step unstable modes grow slowly.
    constexpr double    below  = 0.2;
    double              result = std::numeric_limits<double>::max();
    std::vector<double> squares;
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        of_bodies[b]->set_edge_rates(u, v, squares);
        for (unsigned int c = 0; c < periods[b].size(); ++c)
          {
            const double room = std::log(std::max(1., 2. * periods[b][c] / step)) + below;
            if (squares[c] > 0.)
              result = std::min(result, room / std::sqrt(squares[c]));
          }
      }
    return Utilities::MPI::min(result, map.communicator());
  }



  std::pair<double, double>
  ExplicitCells::scale_masses(const NodeField &u)
  {
    update_periods(u);
    const NodeField rest(u.size());
    ExactSum        total, added;
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        const std::vector<double> steps = steps_of(b, u, rest);
        factors[b].resize(steps.size());
        for (unsigned int c = 0; c < steps.size(); ++c)
          {
            const double step = parameters.courant_factor * steps[c];
            factors[b][c]     = std::max(1., std::pow(parameters.mass_scaling_step / step, 2));
            if (map.cells()[of_bodies[b]->cell_numbers()[c]].owned)
              for (const double mass : of_bodies[b]->masses(c))
                {
                  total.add(mass);
                  added.add((factors[b][c] - 1.) * mass);
                }
          }
      }
    const double all = total.value(map.communicator()), more = added.value(map.communicator());
    if (more > parameters.largest_added_mass * all)
      {
        char text[160];
        std::snprintf(text,
                      sizeof(text),
                      "needs %.4g of additional mass, %.3g of that of all bodies, and 'Largest "
                      "added mass' is %.3g",
                      more,
                      more / all,
                      parameters.largest_added_mass);
        throw InputError("Time integration",
                         "Mass scaling step",
                         Patterns::Tools::to_string(parameters.mass_scaling_step),
                         text,
                         "take a shorter step, a mesh without small cells, or allow that mass");
      }
    sum_masses();
    return {all, more};
  }
} // namespace Touchstone
