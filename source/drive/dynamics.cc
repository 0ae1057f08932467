// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/formula.h>
#include <touchstone/drive/dynamics.h>
#include <touchstone/drive/impact.h>
#include <touchstone/solid/bodies.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/vector_tools_interpolate.h>

#include <algorithm>
#include <cmath>
#include <limits>

/**
 * @file
 * Implicit time integration of the generalized-alpha family: doc/time_integration.md has the
 * formulas and the proof of the energy balance. StepProblem calls begin_step() once, balance() and
 * stiffness() in each Newton iteration, end_step() when Newton has converged, and commit() if the
 * energies of that end are accepted; until then the committed v and a stay as they are, so that a
 * step can be repeated.
 */

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /**
     * Nodal values of three formulas per body, one for each component; an empty formula stands for
     * zero. Nodes at which two bodies meet are separate dofs, so each body sets only its own.
     */
    Vector
    interpolate(const Solid               &solid,
                const std::string         &key,
                std::array<std::string, 3> BodyParameters::*const formulas)
    {
      Formulas all;
      Vector   result(solid.owned, solid.communicator);
      // Interpolation at the support points of the element, which are the nodes.
      const std::vector<Point<dim>> unit = solid.fe.get_unit_support_points();
      std::vector<Index>            dofs(solid.fe.n_dofs_per_cell());
      for (unsigned int b = 0; b < solid.bodies.size(); ++b)
        for (unsigned int d = 0; d < dim; ++d)
          {
            const std::string &formula = (solid.bodies[b].*formulas)[d];
            if (formula.empty())
              continue;
            const auto function =
              all.add(solid.bodies[b].section(), key + std::string(1, "xyz"[d]), formula);
            for (const auto &cell : solid.dof_handler.active_cell_iterators())
              if (cell->is_locally_owned() && cell->material_id() == b)
                {
                  cell->get_dof_indices(dofs);
                  for (unsigned int i = 0; i < dofs.size(); ++i)
                    if (solid.fe.system_to_component_index(i).first == d &&
                        solid.owned.is_element(dofs[i]))
                      result(dofs[i]) =
                        function->value(solid.mapping.transform_unit_to_real_cell(cell, unit[i]),
                                        0.);
                }
          }
      // Collective: a formula that is not finite on one rank must stop all of them.
      all.check(solid.communicator);
      result.compress(VectorOperation::insert);
      // Hanging nodes follow the nodes of the larger cell; a formula evaluated there would tear the
      // interpolated field at the edge.
      solid.hanging.distribute(result);
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
                 ? slaves
                 : std::set<Index>())
    , mass(parameters.mass, solid, massless, step)
    , body(bodies_of_unknowns(solid))
    , damping_mass(solid.owned, solid.communicator)
    , damping_stiffness(damping_mass)
    , v(damping_mass)
    , a(v)
    , old{v, v, v, v, v}
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
              {"support force", &old.support}};
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
    if (!solid.linear() && damping_stiffness.linfty_norm() > 0.)
      initial_stiffness.copy_from(solid.stiffness());
  }



  Vector
  Dynamics::initial_displacement() const
  {
    return interpolate(solid, "Initial displacement ", &BodyParameters::initial_displacement);
  }



  void
  Dynamics::start(const Vector &external, const Vector &internal, const Supports &supports)
  {
    v = interpolate(solid, "Initial velocity ", &BodyParameters::initial_velocity);
    supports.set_velocity(v);
    // Initial acceleration from M a = f_ext - f_int - C v. With the lumped mass this needs no
    // solve, and differs from that of the consistent mass by the order of the mesh size only.
    // Contact forces are left out: bodies that touch at time 0 do not press yet.
    Vector force(external), drag(v);
    force -= internal;
    damping_force(v, drag);
    force -= drag;
    solid.condense(force);
    supports.remove_force(force);
    for (std::size_t i = 0; i < force.locally_owned_size(); ++i)
      a.begin()[i] =
        mass.of_nodes().begin()[i] > 0. ? force.begin()[i] / mass.of_nodes().begin()[i] : 0.;
    solid.hanging.distribute(a);
    // The ledger of energies begins here: the sum of kinetic and strain energy is what all later
    // steps are compared with.
    old.external      = external;
    old.internal      = internal;
    committed.kinetic = kinetic_energy(v);
    committed.strain  = solid.strain_energy(committed_u);
    committed.initial = committed.present();
    committed.update_largest();
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
    inertial_force = inertial.l2_norm();
    sum            = external;
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
  Dynamics::round_off(const Vector &u) const
  {
    // The acceleration is a difference of displacements divided by beta h^2: the round-off of |u_1|
    // + |u_0| + h |v_0| is divided by h^2 as well, and for short steps dominates all other
    // round-off of the residual.
    Vector size(v), inertial(v);
    for (std::size_t i = 0; i < size.locally_owned_size(); ++i)
      size.begin()[i] =
        std::abs(u.begin()[i]) + std::abs(committed_u.begin()[i]) + step * std::abs(v.begin()[i]);
    mass.multiply(size, inertial);
    return std::numeric_limits<double>::epsilon() * (1. - scheme.alpha_m) /
           (scheme.beta * step * step) * inertial.l2_norm();
  }



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
    // velocity needs those at n+gamma: so a force of the end has the weight gamma + m, and one that
    // the balance takes at n+1-f the weight gamma + m - f (doc/time_integration.md, "The energy
    // ledger").
    Vector way(u), mean(v);
    way -= committed_u;
    const double at_end = scheme.gamma + scheme.alpha_m;
    const auto   work   = [&](const Vector &old, const Vector &now, const double theta) {
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
    // Impacts without rebound act on the final velocity, before its kinetic energy is taken.
    if (forces.velocity_constraints != nullptr)
      lose_rebound(forces, result);
    result.kinetic = kinetic_energy(end_v);
    result.strain  = solid.strain_energy(u);
    result.plastic = solid.dissipation();
    // Contact and friction count the work done against their forces. What a moving obstacle does
    // enters through contact and is work of the outside as well, like that of supports.
    result.contact += forces.obstacles_normal - work(old.normal, *forces.normal, at_end);
    result.friction +=
      forces.obstacles_tangential - work(old.tangential, *forces.tangential, at_end);
    result.external += forces.obstacles_normal + forces.obstacles_tangential +
                       work(old.support, *forces.support, at_end) +
                       work(old.external, *forces.external, at_end - scheme.alpha_f);
    // The largest energy so far is the scale of the tolerance for gains of energy.
    result.update_largest();
    return result;
  }



  void
  Dynamics::lose_rebound(const StepForces &forces, Energies &energies)
  {
    // The acceleration first, with B a = 0: it would drive the nodes apart again in the next step.
    // Its impulses correct the contact forces that the next step sees as those of its beginning.
    // Then the velocity, with B v = velocity of the obstacle; the energy lost is the impulse times
    // the mean of the velocities before and after.
    Impact             impact(*forces.velocity_constraints, mass, solid, forces.remove_support);
    const Impact::Loss of_acceleration = impact.stop(end_a, false);
    end_forces.normal -= of_acceleration.normal;
    end_forces.tangential -= of_acceleration.tangential;
    Vector             mean(end_v);
    const Impact::Loss loss = impact.stop(end_v, true);
    mean.sadd(0.5, 0.5, end_v);
    energies.contact += mean * loss.normal - loss.of_obstacles;
    energies.friction += mean * loss.tangential;
    energies.external -= loss.of_obstacles;
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
    external   = *forces.external;
    internal   = *forces.internal;
    normal     = *forces.normal;
    tangential = *forces.tangential;
    support    = *forces.support;
    return *this;
  }



  void
  Dynamics::adopt(const std::vector<Vector>       &rates,
                  const StepForces                &forces,
                  const std::vector<BodyMomentum> &before)
  {
    // The order of rates(): velocity, acceleration.
    v   = rates.front();
    a   = rates.back();
    old = forces;

    // Interpolation on coarsened cells does not conserve momentum. The missing linear and angular
    // momentum of each body without supports is given back by a rigid motion: its six amplitudes
    // solve a 6 x 6 system whose matrix holds the momenta (linear and angular about the origin) of
    // the six unit rigid motions.
    const unsigned int n       = 2 * dim;
    const auto         numbers = [](const BodyMomentum &momentum) {
      dealii::Vector<double> result(n);
      for (unsigned int d = 0; d < dim; ++d)
        {
          result(d)       = momentum.linear[d];
          result(dim + d) = momentum.angular[d];
        }
      return result;
    };
    std::vector<Vector>             motions;
    std::vector<FullMatrix<double>> inertia(before.size(), FullMatrix<double>(n));
    for (unsigned int k = 0; k < n; ++k)
      {
        // Column k of each body's matrix are the momenta of the unit rigid motion k; all bodies
        // move at once, so that six products with M serve any number of bodies.
        motions.push_back(rigid_motion(k));
        const auto momenta = momenta_of(motions.back());
        for (unsigned int b = 0; b < before.size(); ++b)
          for (unsigned int i = 0; i < n; ++i)
            inertia[b](i, k) = numbers(momenta[b])(i);
      }
    const auto now = momenta_of(v);
    for (unsigned int b = 0; b < before.size(); ++b)
      // A supported body exchanges momentum with its supports: it need not keep its own.
      if (!solid.bodies[b].supported())
        {
          dealii::Vector<double> missing = numbers(before[b]), part(n);
          missing -= numbers(now[b]);
          inertia[b].gauss_jordan();
          inertia[b].vmult(part, missing);
          for (std::size_t i = 0; i < body.size(); ++i)
            if (body[i] == b)
              for (unsigned int k = 0; k < n; ++k)
                v.begin()[i] += part(k) * motions[k].begin()[i];
        }
  }



  Vector
  Dynamics::rigid_motion(const unsigned int k) const
  {
    Vector result(v);
    // Reference positions of the nodes, as a vector over the dofs.
    VectorTools::get_position_vector(solid.mapping, solid.dof_handler, result);
    // The rotation is about the origin at the present positions: omega x (X + u).
    result += committed_u;
    const Tensor<1, dim> axis = Point<dim>::unit_vector(k % dim);
    for (std::size_t i = 0; i < result.locally_owned_size(); i += dim)
      {
        Tensor<1, dim> velocity(axis);
        if (k >= dim)
          velocity = cross_product_3d(
            axis, Point<dim>(result.begin()[i], result.begin()[i + 1], result.begin()[i + 2]));
        for (unsigned int d = 0; d < dim; ++d)
          result.begin()[i + d] = velocity[d];
      }
    return result;
  }



  std::vector<BodyMomentum>
  Dynamics::momenta_of(const Vector &velocity) const
  {
    Vector momentum(v), position(v);
    mass.multiply(velocity, momentum);
    VectorTools::get_position_vector(solid.mapping, solid.dof_handler, position);
    position += committed_u;
    std::vector<BodyMomentum> result(solid.bodies.size());
    for (std::size_t i = 0; i < body.size(); i += dim)
      {
        Tensor<1, dim> p, x;
        for (unsigned int d = 0; d < dim; ++d)
          {
            p[d] = momentum.begin()[i + d];
            x[d] = position.begin()[i + d];
          }
        // Sum_i p_i and Sum_i x_i x p_i of the nodal momenta p = M v: exact for any mass matrix
        // that represents rigid motions.
        result[body[i]].mass += mass.of_nodes().begin()[i];
        result[body[i]].linear += p;
        result[body[i]].angular += cross_product_3d(x, p);
      }
    // A body is distributed over all ranks; a rank without a part of it adds zero.
    for (BodyMomentum &sum : result)
      {
        sum.mass    = Utilities::MPI::sum(sum.mass, solid.communicator);
        sum.linear  = Utilities::MPI::sum(sum.linear, solid.communicator);
        sum.angular = Utilities::MPI::sum(sum.angular, solid.communicator);
      }
    return result;
  }
} // namespace Touchstone
