// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exact_sum.h>
#include <touchstone/drive/explicit_step.h>

#include <cmath>

// Energies and momenta of explicit dynamics at the end of an output interval (doc/explicit.md,
// section 6).
namespace Touchstone
{
  using namespace dealii;

  // Half a cycle's work of what a support takes of the forces at this time.
  double
  ExplicitStep::work_ahead(const Balance        &at,
                           const Tensor<1, dim> &v,
                           const unsigned int    node) const
  {
    const Tensor<1, dim> force = at.force(node);
    return 0.5 * at.length * (v * (force - supports.free_part(node, force)));
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
        if (!work.external.empty())
          external.add(work.external[i]);
        if (!work.viscous.empty())
          viscous.add(work.viscous[i]);
        if (!work.damping.empty())
          damped.add(work.damping[i]);
      }
    for (std::size_t k = 0; k < supports.nodes().size(); ++k)
      {
        const unsigned int i     = supports.nodes()[k];
        const double       ahead = work_ahead(now, now.v[i], i);
        kinetic.add(-ahead);
        external.add(-ahead);
        external.add(work_ahead(kept, kept_on_supports[k], i));
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
        const Tensor<1, dim> momentum = mass * now.v[i];
        const Tensor<1, dim> angular =
          cross_product_3d(Tensor<1, dim>(map.positions()[i] + now.u[i]), momentum);
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
} // namespace Touchstone
