// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/base/exact_sum.h>
#include <touchstone/base/non_convergence.h>
#include <touchstone/drive/explicit_step.h>
#include <touchstone/explicit/inverted_cells.h>
#include <touchstone/solid/turned_bodies.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

// History of explicit dynamics: what is kept of an output interval and written to checkpoints
// (doc/explicit.md, sections 6 and 7).
namespace Touchstone
{
  using namespace dealii;

  void
  ExplicitStep::check_inverted() const
  {
    const CellPlace inverted = cells.first(inverted_cell(map, now.u));
    if (!inverted.valid())
      return;
    char time[60];
    std::snprintf(time, sizeof(time), " at time %.6g: ", now.time);
    throw ExplicitFailure("a cell has been turned inside out" +
                          (time + inverted.text(scene.bodies)) +
                          "; it is crushed, between others or by what drives it: check prescribed "
                          "displacements, the motion of obstacles and loads, or take a finer mesh, "
                          "another 'Element', or a law of finite strain, which resists "
                          "compression");
  }



  // Strain energies of bodies at rest are round-off of E V.
  double
  ExplicitStep::round_off_of_energies() const
  {
    constexpr double relative = 1e-14;
    ExactSum         sum;
    for (unsigned int i = 0; i < map.n_owned(); ++i)
      {
        const MaterialParameters &material = scene.bodies[map.body(i)].material;
        sum.add(cells.masses()[i] * material.young_modulus / material.density);
      }
    return relative * sum.value(solid.communicator);
  }



  double
  ExplicitStep::try_commit(const double smallest_part)
  {
    const Energies end       = energies();
    const double   tolerance = scene.time_integration.gain_tolerance;
    // A motion of linear bodies that is not stable keeps the energy of the ledger: its kinetic part
    // becomes as negative as the strain energy grows. Just below the bound of the step that ratio
    // can be large, but not as large as this.
    constexpr double beyond = 1e9;
    if (smallest_part <= 1. &&
        -end.kinetic >
          beyond * (std::abs(end.initial) + std::abs(end.external) + std::abs(end.contact)))
      throw ExplicitFailure("the motion grows without bound, as cycles are longer than is stable: "
                            "take a smaller 'Courant factor'");
    // Springs hold no more than they have taken.
    const double by_springs = std::max(0., held_by_springs - std::max(0., end.contact));
    const double gain       = end.gain() + by_springs;
    if (smallest_part <= 1. && gain > std::max(tolerance * end.largest, round_off_of_energies()))
      {
        // No step is short enough for these.
        if (const std::string turned = turned_bodies(solid, solid.ghosted(displacement)).failure;
            !turned.empty())
          throw ExplicitFailure(turned);
        throw ExplicitFailure(
          "energy " + std::to_string(gain / end.largest) +
          " times the largest so far came from nowhere ('Time "
          "integration/Gain tolerance'): " +
          (by_springs + std::max(0., -end.contact) > 0.5 * gain &&
               contact.enforcement().impulse_rule()->springs()
             ? "contact springs gain energy, take a smaller 'Courant factor' or "
               "'Penalty factor', or 'Contact/Enforcement = forward increment'"
             : "the motion is not stable, take a smaller 'Courant factor' or 'Step "
               "check interval'"));
      }
    // After what is not stable, which inverts cells, too.
    if (smallest_part <= 1.)
      check_inverted();
    committed = end;
    keep();
    obstacles_ahead = obstacles_ahead_now;
    oblique         = oblique_now;
    if (impulses)
      impulses->commit();
    cells.commit();
    work.reset();
    contact.commit();
    return 1.;
  }



  void
  ExplicitStep::keep()
  {
    map.to_vector(now.u, displacement);
    map.to_vector(now.v, velocity);
    kept = now;
    kept_on_supports.clear();
    for (const unsigned int node : supports.nodes())
      kept_on_supports.push_back(now.v[node]);
  }



  void
  ExplicitStep::rollback()
  {
    static_cast<Balance &>(now) = kept;
    map.from_vector(displacement, now.u);
    map.from_vector(velocity, now.v);
    if (impulses)
      impulses->rollback();
    cells.rollback();
    cells.forget();
    work.reset();
    contact.rollback();
  }



  StepTransfer
  ExplicitStep::transfer() const
  {
    AssertThrow(false, ExcInternalError());
    return {};
  }



  void
  ExplicitStep::adopt(const StepTransfer &, double)
  {
    AssertThrow(false, ExcInternalError());
  }



  void
  ExplicitStep::save(ArchiveWriter &archive)
  {
    // After a commit or a rollback: the present state is the committed one.
    archive.put("committed time", kept.time);
    archive.put("cycle", kept.length);
    archive.put("energies", committed);
    Vector field(displacement);
    for (const auto &[name, values] : {std::make_pair("displacement", &now.u),
                                       std::make_pair("velocity", &now.v),
                                       std::make_pair("internal force", &now.internal),
                                       std::make_pair("viscous force", &now.viscous)})
      {
        map.to_vector(*values, field);
        archive.put_field(name, field);
      }
    NodeField of_supports(map.n_owned());
    for (std::size_t k = 0; k < kept.support.size(); ++k)
      of_supports[supports.nodes()[k]] = kept.support[k];
    map.to_vector(of_supports, field);
    archive.put_field("support force", field);
    if (!loads.empty())
      {
        map.to_vector(kept.external, field);
        archive.put_field("external force", field);
      }
    solid.save(archive);
    contact.save(archive);
    archive.put("work of obstacles ahead", obstacles_ahead);
    archive.put("oblique contact", oblique);
    if (impulses)
      impulses->save(archive);
    // What is kept of earlier cycles to save time must be the same in a run that resumes.
    cells.forget();
  }



  void
  ExplicitStep::load(const ArchiveReader &archive)
  {
    now.time   = archive.get<double>("committed time");
    now.length = archive.get<double>("cycle");
    committed  = archive.get<Energies>("energies");
    for (const auto &[name, values] : {std::make_pair("displacement", &now.u),
                                       std::make_pair("velocity", &now.v),
                                       std::make_pair("internal force", &now.internal),
                                       std::make_pair("viscous force", &now.viscous)})
      map.from_vector(archive.field(name), *values);
    NodeField of_supports(map.n_local());
    map.from_vector(archive.field("support force"), of_supports);
    for (std::size_t k = 0; k < now.support.size(); ++k)
      now.support[k] = of_supports[supports.nodes()[k]];
    if (!loads.empty())
      map.from_vector(archive.field("external force"), now.external);
    solid.load(archive);
    cells.forget();
    keep();
    work.reset();
    contact.load(archive);
    if (archive.has("work of obstacles ahead")) // not in checkpoints of earlier versions
      obstacles_ahead = archive.get<double>("work of obstacles ahead");
    if (archive.has("oblique contact"))
      oblique = archive.get<std::vector<ObliqueContact>>("oblique contact");
    if (impulses)
      impulses->load(archive);
  }
} // namespace Touchstone
