// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/dynamics.h>
#include <touchstone/drive/impact.h>

// The end of a step of implicit dynamics: the ledger of energies and the impacts without rebound
// (doc/time_integration.md, "The energy ledger").
namespace Touchstone
{
  using namespace dealii;

  double
  Dynamics::kinetic_energy(const Vector &velocity) const
  {
    Vector momentum(velocity);
    mass.multiply(velocity, momentum);
    return 0.5 * (momentum * velocity);
  }



  Energies
  Dynamics::end_step(const Vector &u, const StepForces &forces)
  {
    end_of_step(u, end_v, end_a);
    // The contact forces of the end of this step are those of the beginning of the next one, and
    // enter the work of both.
    end_forces = forces;

    // Work over the step, force times length. The forces that change the momentum between n and n+1
    // are those of the balance, which refers to the time n+1-m, while Newmark's formula for the
    // velocity needs those at n+gamma: so a contact force, which is of the end, has the weight
    // gamma + m. Loads and supports, which may begin with a kink, have their parts of M a
    // (doc/time_integration.md, "The energy ledger").
    Vector way(u), mean(v);
    way -= committed_u;
    end_forces.load *= 1. - scheme.alpha_f;
    end_forces.load.add(scheme.alpha_f, old.external);
    for (const auto part : {&NodalForces::load, &NodalForces::support})
      (end_forces.*part)
        .sadd(1. / (1. - scheme.alpha_m), -scheme.alpha_m / (1. - scheme.alpha_m), old.*part);
    const auto work = [&](const Vector &old, const Vector &now, const double theta) {
      mean = old;
      mean.sadd(1. - theta, theta, now);
      return mean * way;
    };
    // The terms that are sums over all steps continue from their committed values.
    Energies &result = end;
    result           = committed;
    if (damped)
      {
        // Damping over the step with the mean of the velocities at both ends.
        Vector velocity(v);
        velocity.sadd(0.5, 0.5, end_v);
        damping_force(velocity, mean);
        result.damping += mean * way;
      }
    // Newmark's formula would let massless nodes oscillate, since nothing but their history
    // determines their velocity: they get the mean velocity of the step, (u_1 - u_0)/h, and no
    // acceleration.
    // Owned nodes only; their three dofs are consecutive.
    for (const Index node : massless)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const Index i = node + d;
          end_v(i)      = (u(i) - committed_u(i)) / step;
          end_a(i)      = 0.;
        }
    end_v.compress(VectorOperation::insert);
    end_a.compress(VectorOperation::insert);
    // Hanging nodes follow nodes with and without mass.
    if (mass.moved())
      for (Vector *const rate : {&end_v, &end_a})
        solid.hanging.distribute(*rate);
    // Impacts without rebound act on the final velocity, before its kinetic energy is taken.
    if (forces.velocity_constraints != nullptr)
      lose_rebound(forces, result);
    result.kinetic = kinetic_energy(end_v);
    result.strain  = solid.strain_energy(u);
    result.plastic = solid.dissipation();
    // Contact and friction count the work done against their forces. What moving obstacles
    // and overlaps that are pressed in do enters through contact and is work of the outside as
    // well, like that of supports.
    result.contact += forces.outside_normal - work(old.normal, *forces.normal, forces.end_weight);
    result.friction +=
      forces.outside_tangential - work(old.tangential, *forces.tangential, forces.end_weight);
    result.external += forces.outside_normal + forces.outside_tangential +
                       work(old.support, end_forces.support, scheme.gamma) +
                       work(old.load, end_forces.load, scheme.gamma);
    // The largest energy so far is the scale of the tolerance for gains of energy.
    result.update_largest();
    return result;
  }



  void
  Dynamics::lose_rebound(const StepForces &forces, Energies &energies)
  {
    // The acceleration first, with B a = acceleration of the obstacle: it would drive the nodes
    // apart again in the next step. Its impulses correct the contact forces that the next step sees
    // as those of its beginning. Then the velocity, with B v = velocity of the obstacle; the energy
    // lost is the impulse times the mean of the velocities before and after.
    Impact             impact(*forces.velocity_constraints, mass, solid, forces.remove_support);
    const Impact::Loss of_acceleration = impact.stop(end_a, false);
    end_forces.normal -= of_acceleration.normal;
    end_forces.tangential -= of_acceleration.tangential;
    Vector             mean(end_v);
    const Impact::Loss loss = impact.stop(end_v, true);
    mean.sadd(0.5, 0.5, end_v);
    energies.contact += mean * loss.normal - loss.normal_of_obstacles;
    energies.friction += mean * loss.tangential - loss.tangential_of_obstacles;
    energies.external -= loss.normal_of_obstacles + loss.tangential_of_obstacles;
  }



  // The displacement is committed by StepProblem.
  void
  Dynamics::commit()
  {
    v   = end_v;
    a   = end_a;
    old = end_forces;
    TimeIntegration::commit();
  }



  Dynamics::NodalForces &
  Dynamics::NodalForces::operator=(const StepForces &forces)
  {
    external = load = *forces.external;
    internal        = *forces.internal;
    normal          = *forces.normal;
    tangential      = *forces.tangential;
    support         = *forces.support;
    return *this;
  }
} // namespace Touchstone
