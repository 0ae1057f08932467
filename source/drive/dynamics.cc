// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/reduction.h>
#include <touchstone/drive/dynamics.h>
#include <touchstone/solid/bodies.h>

#include <cmath>
#include <limits>

/**
 * @file
 * Implicit time integration of the generalized-alpha family: doc/time_integration.md has the
 * formulas and the proof of the energy balance. StepProblem calls begin_step() once, balance() and
 * stiffness() in each Newton iteration, end_step() when Newton has converged, and commit() if the
 * energies of that end are accepted; until then the committed v and a stay as they are, so that a
 * step can be repeated.
 * The start is in dynamics_start.cc, energies of a step in dynamics_energy.cc, momenta in
 * dynamics_momentum.cc.
 */

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Slave nodes, and hanging nodes that follow any of them: these leave to the nodes that they
     * follow what mass they have. Owned nodes; collective. */
    std::set<Index>
    without_mass(const std::set<Index> &slaves, const Solid &solid)
    {
      Vector flag(solid.zero_vector());
      for (const Index node : slaves)
        flag(node) = 1.;
      flag.compress(VectorOperation::insert);
      const Vector    of_slaves = solid.ghosted(flag);
      std::set<Index> result(slaves);
      for (const auto &line : solid.hanging.get_lines())
        if (line.index % dim == 0 && solid.owned.is_element(line.index))
          for (const auto &[parent, weight] : line.entries)
            if (of_slaves(parent) > 0.)
              result.insert(line.index);
      return result;
    }
  } // namespace



  Dynamics::Dynamics(const TimeIntegrationParameters &parameters,
                     const double                     step,
                     const Solid                     &solid,
                     const std::set<Index>           &slaves,
                     const Vector                    &committed_u)
    : solid(solid)
    , committed_u(committed_u)
    , scheme(parameters.coefficients())
    , massless(parameters.scheme == TimeIntegrationParameters::Scheme::contact_stabilized
                 ? without_mass(slaves, solid)
                 : std::set<Index>())
    , mass(parameters.mass, solid, massless, step)
    , body(bodies_of_unknowns(solid))
    , damping_mass(solid.zero_vector())
    , damping_stiffness(damping_mass)
    , v(damping_mass)
    , a(v)
    , old{v, v, v, v, v, v}
    , end_v(v)
    , end_a(v)
    , end_forces(old)
  {
    fields = {{"velocity", &v},
              {"acceleration", &a},
              {"external force", &old.external},
              {"internal force", &old.internal},
              {"normal contact force", &old.normal},
              {"tangential contact force", &old.tangential},
              {"support force", &old.support},
              // The same where loads change smoothly.
              {"load in inertia", &old.load, "external force"}};
    for (std::size_t i = 0; i < body.size(); ++i)
      {
        // Rayleigh damping C = a M + b K0 with a and b of the body: kept per dof, so that a product
        // with C is a product with M or K0 and a scaling of its rows (no dof couples two bodies).
        const MaterialParameters &material = solid.bodies[body[i]].material;
        damping_mass.begin()[i]            = material.rayleigh_mass;
        damping_stiffness.begin()[i]       = material.rayleigh_stiffness;
      }
    damped = damping_mass.linfty_norm() > 0. || damping_stiffness.linfty_norm() > 0.;
    // The stiffness of nonlinear bodies changes with the displacement, but K0 in C is that of the
    // undeformed body, which is the present one here.
    if (!solid.linear() && damped)
      initial_stiffness.copy_from(solid.stiffness());
  }



  void
  Dynamics::begin_step(const double t, Vector &u)
  {
    time = t;
    step = time - committed_time;
    u.add(step, v);
    // The predictor of free flight can turn cells inside out (det F <= 0), where a hyperelastic law
    // has no value; then Newton's method starts at the committed displacement.
    if (!solid.admissible(u))
      u = committed_u;
  }



  void
  Dynamics::end_of_step(const Vector &u, Vector &velocity, Vector &acceleration) const
  {
    // Newmark's formulas, doc/time_integration.md, "Balance of a step": a_1 = (u_1 - u_0 - h v_0) /
    // (beta h^2) - (1 / (2 beta) - 1) a_0 and v_1 = v_0 + h (1 - gamma) a_0 + h gamma a_1.
    acceleration = u;
    acceleration -= committed_u;
    acceleration.add(-step, v);
    acceleration *= 1. / (scheme.beta * step * step);
    acceleration.add(1. - 0.5 / scheme.beta, a);
    velocity = v;
    velocity.add(step * (1. - scheme.gamma), a, step * scheme.gamma, acceleration);
  }



  void
  Dynamics::damping_force(const Vector &velocity, Vector &force) const
  {
    force = 0.;
    if (!damped)
      return;
    // C v = b K0 v + a M v, each part scaled by the factor of the body.
    damping_matrix().vmult(force, velocity);
    force.scale(damping_stiffness);
    Vector momentum(v);
    mass.multiply(velocity, momentum);
    momentum.scale(damping_mass);
    force += momentum;
  }



  void
  Dynamics::balance(const Vector &u, const Vector &external, const Vector &internal, Vector &sum)
  {
    // Each force enters at its own time within the step: inertia at n+1-m, loads, stresses and
    // damping at n+1-f. Contact is not part of it: its force is that of the end of the step
    // (doc/time_integration.md, "Why contact takes energy, and never gives any").
    const double alpha_f = scheme.alpha_f, alpha_m = scheme.alpha_m;
    Vector       velocity(v), acceleration(v), inertial(v);
    end_of_step(u, velocity, acceleration);
    acceleration *= 1. - alpha_m;
    acceleration.add(alpha_m, a);
    mass.multiply(acceleration, inertial);
    // One of the forces that the residual is compared with when convergence is judged.
    inertial_force_squared = squared_on_rank(inertial);
    sum                    = external;
    sum -= internal;
    sum *= 1. - alpha_f;
    sum.add(alpha_f, old.external, -alpha_f, old.internal);
    sum -= inertial;
    if (damped)
      {
        velocity *= 1. - alpha_f;
        velocity.add(alpha_f, v);
        damping_force(velocity, inertial);
        sum -= inertial;
      }
  }



  const Matrix &
  Dynamics::stiffness()
  {
    // Derivative of balance() with respect to u_1, with changed sign: (1-f) K + (1-m)/(beta h^2) M
    // + (1-f) gamma/(beta h) C. For linear bodies it depends on the step size alone, and a
    // factorisation of it stays valid.
    if (solid.linear() && effective_step == step)
      return effective;
    effective_step = step;
    effective.copy_from(solid.stiffness());
    effective *= 1. - scheme.alpha_f;
    const double of_mass    = (1. - scheme.alpha_m) / (scheme.beta * step * step),
                 of_damping = (1. - scheme.alpha_f) * scheme.gamma / (scheme.beta * step);
    // The mass of the inertia and that of the Rayleigh damping have the same pattern: one pass adds
    // both.
    Vector factors(damping_mass);
    factors *= of_damping;
    for (double &factor : factors)
      factor += of_mass;
    mass.add_to(effective, factors);
    if (damped)
      {
        factors = damping_stiffness;
        factors *= of_damping;
        effective.add(factors, damping_matrix());
      }
    return effective;
  }



  double
  Dynamics::round_off_squared(const Vector &u) const
  {
    // The acceleration is a difference of displacements divided by beta h^2: the round-off of |u_1|
    // + |u_0| + h |v_0| is divided by h^2 as well, and for short steps dominates all other
    // round-off of the residual.
    Vector size(v), inertial(v);
    for (std::size_t i = 0; i < size.locally_owned_size(); ++i)
      size.begin()[i] =
        std::abs(u.begin()[i]) + std::abs(committed_u.begin()[i]) + step * std::abs(v.begin()[i]);
    mass.multiply(size, inertial);
    const double factor =
      std::numeric_limits<double>::epsilon() * (1. - scheme.alpha_m) / (scheme.beta * step * step);
    return factor * factor * squared_on_rank(inertial);
  }
} // namespace Touchstone
