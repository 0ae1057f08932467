// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/motion.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>

/**
 * @file
 * Impacts, velocities and energies of a run with inertia, for the summary: collected after each
 * step.
 */

namespace Touchstone
{
  namespace
  {
    /**
     * Energies by name, in the order of the balance (doc/time_integration.md, "The energy ledger").
     */
    std::vector<std::pair<std::string, double>>
    by_name(const Energies &energies)
    {
      std::vector<std::pair<std::string, double>> result = {{"initial", energies.initial},
                                                            {"external", energies.external},
                                                            {"kinetic", energies.kinetic},
                                                            {"strain", energies.strain},
                                                            {"plastic", energies.plastic},
                                                            {"contact", energies.contact},
                                                            {"friction", energies.friction},
                                                            {"damping", energies.damping}};
      // Of explicit dynamics only.
      if (energies.hourglass != 0.)
        result.emplace_back("hourglass", energies.hourglass);
      if (energies.viscous != 0.)
        result.emplace_back("viscous", energies.viscous);
      result.emplace_back("balance_error", energies.balance_error());
      return result;
    }

    /**
     * Zero for what is below 1e-7 of the scale: such digits differ from run to run and would make
     * printed results differ.
     */
    double
    significant(const double value, const double scale)
    {
      return std::abs(value) < 1e-7 * scale ? 0. : value;
    }
  } // namespace



  void
  Motion::add_step(const std::string &pair,
                   const double       begin,
                   const double       end,
                   const PairResult  &result)
  {
    Impact      &impact   = impacts[pair];
    const bool   touching = result.active > 0;
    const double force    = result.force.norm();
    // Contact begins at the beginning of the first step that ends in contact, since forces are
    // those of the end of a step; its end is the last such end.
    if (touching && !impact.touched)
      impact.begin = begin;
    if (touching)
      impact.end = end;
    // Transitions from contact to no contact.
    impact.openings += (impact.touching && !touching);
    impact.touched  = impact.touched || touching;
    impact.touching = touching;
    impact.impulse += (end - begin) * result.mean_force;
    impact.peak_force = std::max(impact.peak_force, force);
  }



  Json
  Motion::to_json() const
  {
    Json pairs = Json::object();
    for (const auto &[name, impact] : impacts)
      pairs.set(name,
                Json::object()
                  .set("begin", impact.begin)
                  .set("end", impact.end)
                  .set("openings", impact.openings)
                  .set("impulse", impact.impulse)
                  .set("peak_force", impact.peak_force));
    Json bodies = Json::object();
    for (const auto &[name, velocity] : velocities)
      bodies.set(name, velocity);
    Json all = Json::object();
    for (const auto &[name, energy] : by_name(energies))
      all.set(name, energy);
    return Json::object().set("impacts", pairs).set("velocities", bodies).set("energies", all);
  }



  void
  Motion::print(std::ostream &out) const
  {
    const auto number = [&out](const double value, const double scale) {
      out << ' ' << std::setw(12) << significant(value, scale);
    };
    for (const auto &[name, impact] : impacts)
      {
        out << "Impact of " << name << '\n' << "  from, to       ";
        number(impact.begin, impact.end);
        number(impact.end, impact.end);
        out << '\n' << "  opened          " << std::setw(12) << impact.openings << '\n';
        out << "  impulse        ";
        for (unsigned int d = 0; d < dim; ++d)
          number(impact.impulse[d], impact.impulse.norm());
        out << '\n' << "  peak force     ";
        number(impact.peak_force, impact.peak_force);
        out << '\n';
      }
    double fastest = 0.;
    for (const auto &[name, velocity] : velocities)
      fastest = std::max(fastest, velocity.norm());
    for (const auto &[name, velocity] : velocities)
      {
        out << "Velocity of " << name << '\n' << "  mean           ";
        for (unsigned int d = 0; d < dim; ++d)
          number(velocity[d], fastest);
        out << '\n';
      }
    out << "Energies\n";
    for (const auto &[name, energy] : by_name(energies))
      {
        std::string label = name;
        std::replace(label.begin(), label.end(), '_', ' ');
        out << "  " << std::left << std::setw(13) << label << std::right;
        number(energy, energies.largest);
        out << '\n';
      }
  }
} // namespace Touchstone
