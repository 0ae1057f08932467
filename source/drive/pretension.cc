// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/base/non_convergence.h>
#include <touchstone/contact/results.h>
#include <touchstone/drive/broyden.h>
#include <touchstone/drive/pretension.h>

#include <algorithm>
#include <cmath>
#include <limits>

// Pretension of bolts (doc/theory.md 4.3).
namespace Touchstone
{
  using namespace dealii;

  Pretension::Pretension(const std::vector<ContactPairParameters> &pairs,
                         const LoadSteppingParameters             &load_stepping,
                         Contact                                  &contact)
    : contact(contact)
  {
    for (unsigned int p = 0; p < pairs.size(); ++p)
      if (const ContactPairParameters &pair = pairs[p]; pair.has_pretension())
        {
          Cut cut{p,
                  pair.name,
                  formulas.add(pair.section(), "Pretension force", pair.pretension_force),
                  formulas.add(pair.section(), "Pretension shortening", pair.pretension_shortening),
                  std::numeric_limits<double>::infinity()};
          for (const LoadPhase &phase : load_stepping.phases)
            if (phase.name == pair.pretension_until)
              cut.lock = phase.end_time;
          cuts.push_back(cut);
        }
    const std::size_t n = cuts.size();
    present.shortening.resize(n);
    present.tension.resize(n);
    present.compliance.resize(n * n);
    committed = present;
  }



  void
  Pretension::apply()
  {
    for (unsigned int c = 0; c < cuts.size(); ++c)
      contact.set_shortening(cuts[c].pair, present.shortening[c]);
  }



  void
  Pretension::begin_step(const double t)
  {
    if (cuts.empty())
      return;
    time      = t;
    n_changes = 0;
    last_residual.clear();
    const std::size_t   n = cuts.size();
    std::vector<double> change(n);
    for (unsigned int c = 0; c < n; ++c)
      if (time > cuts[c].lock)
        continue; // as long as it is
      else if (cuts[c].shortening)
        present.shortening[c] = cuts[c].shortening->value(Point<dim>(), t);
      else
        change[c] = cuts[c].force->value(Point<dim>(), t) - committed.tension[c];
    formulas.check(contact.communicator());
    // What earlier steps have told of the compliance is the first guess; nothing if this is the
    // first step.
    for (unsigned int c = 0; c < n; ++c)
      if (by_force(cuts[c]))
        {
          present.shortening[c] = committed.shortening[c];
          for (unsigned int k = 0; k < n; ++k)
            present.shortening[c] += present.compliance[c * n + k] * change[k];
        }
    apply();
  }



  std::vector<std::pair<double, double>>
  Pretension::tensions(const Vector &u) const
  {
    const std::vector<PairResult>          results = pair_results(contact, u);
    std::vector<std::pair<double, double>> all;
    for (const Cut &cut : cuts)
      all.emplace_back(-(results[cut.pair].force * contact.pair(cut.pair).cut()->normal(u)),
                       results[cut.pair].area);
    return all;
  }



  void
  Pretension::learn(const std::vector<double> &residual)
  {
    const std::size_t   n = cuts.size();
    std::vector<double> dx(n), dr(n);
    for (unsigned int c = 0; c < n; ++c)
      if (by_force(cuts[c]))
        {
          dx[c] = present.shortening[c] - last_shortening[c];
          dr[c] = residual[c] - last_residual[c];
        }
    broyden_update(present.compliance, dx, dr);
  }



  bool
  Pretension::correct(const Vector &u)
  {
    if (cuts.empty())
      return false;
    // A hundred times the round-off to which Newton's method finds forces.
    constexpr double    tolerance = 1e-8;
    constexpr unsigned  most      = 30;
    const std::size_t   n         = cuts.size();
    const auto          forces    = tensions(u);
    std::vector<double> residual(n);
    double              scale = 0., worst = 0.;
    unsigned int        worst_cut = 0;
    for (unsigned int c = 0; c < n; ++c)
      {
        present.tension[c]  = forces[c].first;
        found[cuts[c].name] = {present.shortening[c], forces[c].first};
        scale = std::max({scale, std::abs(forces[c].first), std::abs(committed.tension[c])});
        if (!by_force(cuts[c]))
          continue;
        const double wanted = cuts[c].force->value(Point<dim>(), time);
        scale               = std::max(scale, std::abs(wanted));
        residual[c]         = forces[c].first - wanted;
        if (std::abs(residual[c]) > worst)
          {
            worst     = std::abs(residual[c]);
            worst_cut = c;
          }
      }
    if (worst <= tolerance * scale)
      return false;
    if (++n_changes > most)
      throw NotBalanced("the tension of the pair '" + cuts[worst_cut].name +
                          "' does not come to its 'Pretension force': it is " +
                          Patterns::Tools::to_string(forces[worst_cut].first) +
                          " at a shortening of " +
                          Patterns::Tools::to_string(present.shortening[worst_cut]),
                        worst / scale);
    // Small changes say more of the round-off in forces than of the compliance.
    constexpr double telling = 1e-6;
    double           change  = 0.;
    for (unsigned int c = 0; c < n && !last_residual.empty(); ++c)
      change = std::max(change, std::abs(residual[c] - last_residual[c]));
    if (change > telling * scale)
      learn(residual);
    // What nothing is known of yet: a bar as long as it is thick, as stiff as the softer side.
    for (unsigned int c = 0; c < n; ++c)
      if (by_force(cuts[c]) && present.compliance[c * n + c] == 0.)
        present.compliance[c * n + c] =
          1. / (contact.pair(cuts[c].pair).modulus() * std::sqrt(forces[c].second));
    last_shortening = present.shortening;
    last_residual   = residual;
    // No correction is larger than what the tension would shorten a bolt of that kind by, or than
    // the shortening so far: where contact closes or opens, a compliance says little farther away.
    std::vector<double> step(n);
    double              part = 1.;
    for (unsigned int c = 0; c < n; ++c)
      if (by_force(cuts[c]))
        {
          for (unsigned int k = 0; k < n; ++k)
            step[c] -= present.compliance[c * n + k] * residual[k];
          const double largest =
            std::max(std::abs(present.shortening[c]),
                     10. * scale /
                       (contact.pair(cuts[c].pair).modulus() * std::sqrt(forces[c].second)));
          part = std::min(part, largest / std::max(largest, std::abs(step[c])));
        }
    for (unsigned int c = 0; c < n; ++c)
      present.shortening[c] += part * step[c];
    apply();
    return true;
  }



  bool
  Pretension::by_force() const
  {
    return std::any_of(cuts.begin(), cuts.end(), [this](const Cut &cut) { return by_force(cut); });
  }



  void
  Pretension::commit()
  {
    committed = present;
  }



  void
  Pretension::rollback()
  {
    present = committed;
    // What is reported, too: a run that ends here shows its last state that converged.
    for (unsigned int c = 0; c < cuts.size(); ++c)
      if (const auto of_cut = found.find(cuts[c].name); of_cut != found.end())
        of_cut->second = {committed.shortening[c], committed.tension[c]};
    apply();
  }



  void
  Pretension::save(ArchiveWriter &archive) const
  {
    if (!cuts.empty())
      archive.put("pretension", committed);
  }



  void
  Pretension::load(const ArchiveReader &archive)
  {
    if (cuts.empty())
      return;
    committed = present = archive.get<State>("pretension");
    apply();
  }
} // namespace Touchstone
