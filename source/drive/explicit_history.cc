// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/base/exact_sum.h>
#include <touchstone/base/non_convergence.h>
#include <touchstone/drive/explicit_step.h>
#include <touchstone/explicit/inverted_cells.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

// History of explicit dynamics: energies and momenta at the end of an output interval, what is kept
// of it and written to checkpoints (doc/explicit.md, sections 6 and 7).
namespace Touchstone
{
  using namespace dealii;

  // Half a cycle's work of what a support takes of the forces at this time.
  double
  ExplicitStep::work_ahead(const State &at, const unsigned int node) const
  {
    if (!supports.supported(node))
      return 0.;
    const Tensor<1, dim> force = at.force(node);
    return 0.5 * at.length * (at.v[node] * (force - supports.free_part(node, force)));
  }



  Energies
  ExplicitStep::energies()
  {
    // Of two velocities half a cycle before and after the end the product is the kinetic energy
    // that the forces of this time give: with it the ledger closes up to round-off for linear
    // bodies (doc/explicit.md, section 6). Forces that supports take give no velocity: kinetic
    // energy and work of supports are both without that half cycle.
    ExactSum kinetic, external, viscous, damped;
    for (unsigned int i = 0; i < map.n_owned(); ++i)
      {
        const Tensor<1, dim> force = now.force(i);
        kinetic.add(0.5 *
                    (cells.masses()[i] * (now.v[i] * now.v[i]) + now.length * (now.v[i] * force)));
        kinetic.add(-work_ahead(now, i));
        external.add(work[i].external);
        external.add(work_ahead(kept, i));
        external.add(-work_ahead(now, i));
        viscous.add(work[i].viscous);
        damped.add(work[i].damping);
      }
    const MPI_Comm                communicator = solid.communicator;
    const ExplicitCells::Energies of_cells     = cells.energies(now.u);
    Energies                      result       = committed;
    result.kinetic                             = kinetic.value(communicator);
    result.strain                              = of_cells.strain;
    result.plastic                             = of_cells.plastic;
    result.hourglass                           = of_cells.hourglass;
    result.external += external.value(communicator);
    result.viscous += viscous.value(communicator);
    result.damping += damped.value(communicator);
    if (impulses)
      {
        // Forces of stress that moving obstacles balance give no velocity either: as of supports,
        // half a cycle's work is left out.
        const ImpulseEnergy by_contact = impulses->energy();
        result.contact -= by_contact.normal;
        result.friction -= by_contact.friction;
        result.external += by_contact.obstacles + (by_contact.ahead - obstacles_ahead);
        result.kinetic += by_contact.ahead;
        obstacles_ahead_now = by_contact.ahead;
        held_by_springs     = by_contact.stored;
      }
    result.update_largest();
    return result;
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
    if (smallest_part <= 1. && gain > tolerance * end.largest)
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
    // After what is not stable, which inverts cells, too.
    if (const CellPlace inverted = cells.first(inverted_cell(map, now.u));
        smallest_part <= 1. && inverted.valid())
      {
        char time[60];
        std::snprintf(time, sizeof(time), " at time %.6g: ", now.time);
        throw ExplicitFailure("a cell has been turned inside out" +
                              (time + inverted.text(scene.bodies)) +
                              "; it is crushed, between others or by what drives it: check "
                              "prescribed displacements, the motion of obstacles and loads, or "
                              "take a law of finite strain, which resists compression");
      }
    committed       = end;
    kept            = now;
    obstacles_ahead = obstacles_ahead_now;
    if (impulses)
      impulses->commit();
    cells.commit();
    std::fill(work.begin(), work.end(), NodalWork());
    update_results();
    contact.commit();
    return 1.;
  }



  void
  ExplicitStep::update_results()
  {
    map.to_vector(kept.u, displacement);
    map.to_vector(kept.v, velocity);
  }



  void
  ExplicitStep::rollback()
  {
    now = kept;
    if (impulses)
      impulses->rollback();
    cells.rollback();
    std::fill(work.begin(), work.end(), NodalWork());
    contact.rollback();
  }



  std::vector<BodyMomentum>
  ExplicitStep::momenta() const
  {
    struct Sums
    {
      ExactSum                  mass;
      std::array<ExactSum, dim> linear, angular;
    };
    std::vector<Sums> sums(scene.bodies.size());
    for (unsigned int i = 0; i < map.n_owned(); ++i)
      {
        const double         mass     = cells.masses()[i];
        const Tensor<1, dim> momentum = mass * kept.v[i];
        const Tensor<1, dim> angular =
          cross_product_3d(Tensor<1, dim>(map.positions()[i] + kept.u[i]), momentum);
        Sums &sum = sums[map.body(i)];
        sum.mass.add(mass);
        for (unsigned int d = 0; d < dim; ++d)
          {
            sum.linear[d].add(momentum[d]);
            sum.angular[d].add(angular[d]);
          }
      }
    std::vector<BodyMomentum> result(sums.size());
    for (std::size_t b = 0; b < sums.size(); ++b)
      {
        result[b].mass = sums[b].mass.value(solid.communicator);
        for (unsigned int d = 0; d < dim; ++d)
          {
            result[b].linear[d]  = sums[b].linear[d].value(solid.communicator);
            result[b].angular[d] = sums[b].angular[d].value(solid.communicator);
          }
      }
    return result;
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
    archive.put("committed time", kept.time);
    archive.put("cycle", kept.length);
    archive.put("energies", committed);
    Vector field(displacement);
    for (const auto &[name, values] : {std::make_pair("displacement", &kept.u),
                                       std::make_pair("velocity", &kept.v),
                                       std::make_pair("internal force", &kept.internal),
                                       std::make_pair("viscous force", &kept.viscous)})
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
    kept = now;
    std::fill(work.begin(), work.end(), NodalWork());
    map.to_vector(kept.u, displacement);
    map.to_vector(kept.v, velocity);
    contact.load(archive);
    if (archive.has("work of obstacles ahead")) // not in checkpoints of earlier versions
      obstacles_ahead = archive.get<double>("work of obstacles ahead");
    if (impulses)
      impulses->load(archive);
  }
} // namespace Touchstone
