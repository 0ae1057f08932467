// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/rigid_tools.h>

#include <algorithm>
#include <array>
#include <cmath>

// The balance of obstacles that forces move, in implicit steps (doc/theory.md 4.5, equation (32)).
namespace Touchstone
{
  using namespace dealii;

  RigidTools::Components
  RigidTools::inertia(RigidTool &tool, const Components &motion) const
  {
    // Newmark's formulas for the reference point, and for turns in axes that turn with the obstacle
    // (Simo and Vu-Quoc 1988, Comput. Methods Appl. Mech. Eng. 66).
    const RigidTool::State &from = tool.committed;
    RigidTool::State       &to   = tool.present;
    Components              way  = motion;
    Tensor<1, dim>          turned, force, moment, spin_before, spin;
    for (unsigned int d = 0; d < dim; ++d)
      turned[d] = motion[dim + d];
    turned = turned * from.turn; // transposed
    for (unsigned int d = 0; d < dim; ++d)
      way[dim + d] = turned[d];
    for (unsigned int c = 0; c < RigidTool::n_components; ++c)
      if (tool.free().is_free(c))
        {
          to.acceleration[c] = (way[c] - step * from.velocity[c]) / (scheme->beta * step * step) +
                               (1. - 0.5 / scheme->beta) * from.acceleration[c];
          to.velocity[c] = from.velocity[c] + step * ((1. - scheme->gamma) * from.acceleration[c] +
                                                      scheme->gamma * to.acceleration[c]);
          const double mean =
            (1. - scheme->alpha_m) * to.acceleration[c] + scheme->alpha_m * from.acceleration[c];
          (c < dim ? force[c] : moment[c - dim]) = tool.free().resistance(c) * mean;
          if (c >= dim)
            {
              spin[c - dim]        = to.velocity[c];
              spin_before[c - dim] = from.velocity[c];
            }
        }
    const auto gyroscopic = [&](const Tensor<1, dim> &omega) {
      Tensor<1, dim> momentum;
      for (unsigned int d = 0; d < dim; ++d)
        momentum[d] = tool.free().inertia[d] * omega[d];
      return cross_product_3d(omega, momentum);
    };
    // The mean of the accelerations is that at the time of the balance, whatever alpha_m, and is to
    // be seen in the axes of that time; forces and momenta turn with those of their ends.
    const double at_start = scheme->alpha_f, at_end = 1. - scheme->alpha_f;
    moment = at_end * (to.turn * (moment + gyroscopic(spin))) +
             at_start * (from.turn * (moment + gyroscopic(spin_before)));
    Components result{};
    for (unsigned int d = 0; d < dim; ++d)
      {
        result[d]       = force[d];
        result[dim + d] = moment[d];
      }
    return result;
  }



  RigidTools::Residual
  RigidTools::residual(const std::vector<PairResult> &results)
  {
    Residual result;
    // By obstacle, of forces and of moments.
    std::vector<std::array<double, 2>> sizes(tools.size());
    const double                       old = scheme ? scheme->alpha_f : 0.;
    for (unsigned int t = 0; t < tools.size(); ++t)
      {
        RigidTool &tool          = tools[t];
        tool.present.load        = tool.load(time);
        tool.present.contact     = tool.force_of_bodies(results, time);
        const Components resists = scheme ? inertia(tool, motion_of(t)) : Components{};
        // Also what holds it in its other directions: to a part of all of these forces are exact.
        for (unsigned int c = 0; c < RigidTool::n_components; ++c)
          result.of_bodies =
            std::max(result.of_bodies,
                     std::abs(tool.present.contact[c]) / (c < dim ? 1. : tool.length()));
        for (const Unknown &unknown : unknowns)
          if (unknown.tool == t)
            {
              const unsigned int c = unknown.component;
              const double load = (1. - old) * tool.present.load[c] + old * tool.committed.load[c];
              result.missing.push_back((resists[c] - tool.present.contact[c] - load) /
                                       unknown.scale);
              result.of_loads = std::max(result.of_loads, std::abs(load) / unknown.scale);
              for (const double force : {resists[c],
                                         tool.present.contact[c],
                                         tool.committed.contact[c],
                                         load,
                                         tool.committed.load[c]})
                sizes[t][c / dim] = std::max(sizes[t][c / dim], std::abs(force) / unknown.scale);
            }
      }
    for (const Unknown &unknown : unknowns)
      {
        result.size.push_back(sizes[unknown.tool][unknown.component / dim]);
        result.largest = std::max(result.largest, result.size.back());
      }
    result.of_bodies = std::max(result.of_bodies, result.largest);
    return result;
  }



  std::optional<std::size_t>
  RigidTools::worst(const Residual &residual) const
  {
    // A hundred times the round-off to which Newton's method finds forces.
    const double               tolerance = std::max(1e-8, 10. * residual_tolerance);
    std::optional<std::size_t> result;
    double                     most = 1.;
    for (std::size_t k = 0; k < unknowns.size(); ++k)
      {
        const RigidTool &tool = tools[unknowns[k].tool];
        // Moments that vanish between large forces, and forces of bodies that only touch.
        const double bound = std::max({tolerance * residual.size[k],
                                       2. * residual_tolerance * residual.of_bodies,
                                       1e-14 * tool.modulus() * tool.length() * tool.length()});
        if (std::abs(residual.missing[k]) > most * bound)
          {
            most   = std::abs(residual.missing[k]) / bound;
            result = k;
          }
      }
    return result;
  }



  // As stiff as the softest body under a punch of the size of the contact; and inertia.
  RigidTools::Numbers
  RigidTools::stiffness(const std::vector<PairResult> &results) const
  {
    Numbers result;
    for (const Unknown &unknown : unknowns)
      {
        const RigidTool &tool = tools[unknown.tool];
        double           area = 0.;
        for (const unsigned int p : tool.pairs())
          area += results[p].area;
        double sum = 0.;
        if (area > 0. || !scheme)
          sum += tool.modulus() * std::max(tool.face(), std::sqrt(area));
        if (scheme)
          sum += (1. - scheme->alpha_m) * tool.free().resistance(unknown.component) /
                 (scheme->beta * step * step * unknown.scale * unknown.scale);
        result.push_back(sum);
      }
    return result;
  }
} // namespace Touchstone
