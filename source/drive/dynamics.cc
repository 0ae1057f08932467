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

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Three formulas for each body, at its nodes; empty ones are zero. */
    Vector
    interpolate(const Solid               &solid,
                const std::string         &key,
                std::array<std::string, 3> BodyParameters::*const formulas)
    {
      Formulas                      all;
      Vector                        result(solid.owned, solid.communicator);
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
      all.check(solid.communicator);
      result.compress(VectorOperation::insert);
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
    , old_external(v)
    , old_internal(v)
    , old_normal(v)
    , old_tangential(v)
    , old_support(v)
    , end_v(v)
    , end_a(v)
    , end_normal(v)
    , end_tangential(v)
  {
    for (std::size_t i = 0; i < body.size(); ++i)
      {
        const MaterialParameters &material = solid.bodies[body[i]].material;
        damping_mass.begin()[i]            = material.rayleigh_mass;
        damping_stiffness.begin()[i]       = material.rayleigh_stiffness;
      }
    damped = damping_mass.linfty_norm() > 0. || damping_stiffness.linfty_norm() > 0.;
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
    // With all mass at the nodes the acceleration needs no solve, and is the same up to
    // the mesh size.
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
    old_external      = external;
    old_internal      = internal;
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
    // What the flight turns inside out is no place to begin.
    if (!solid.admissible(u))
      u = committed_u;
  }



  void
  Dynamics::end_of_step(const Vector &u, Vector &velocity, Vector &acceleration) const
  {
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
    const double alpha_f = scheme.alpha_f, alpha_m = scheme.alpha_m;
    Vector       velocity(v), acceleration(v), inertial(v);
    end_of_step(u, velocity, acceleration);
    acceleration *= 1. - alpha_m;
    acceleration.add(alpha_m, a);
    mass.multiply(acceleration, inertial);
    inertial_force = inertial.l2_norm();
    sum            = external;
    sum -= internal;
    sum *= 1. - alpha_f;
    sum.add(alpha_f, old_external, -alpha_f, old_internal);
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
    if (solid.linear() && effective_step == step)
      return effective;
    effective_step = step;
    effective.copy_from(solid.stiffness());
    effective *= 1. - scheme.alpha_f;
    const double of_mass    = (1. - scheme.alpha_m) / (scheme.beta * step * step),
                 of_damping = (1. - scheme.alpha_f) * scheme.gamma / (scheme.beta * step);
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
    end_normal     = *forces.normal;
    end_tangential = *forces.tangential;

    // The forces that change the momentum over the step: those in the balance stand
    // for the time n + 1 - m, and Newmark's formula asks for n + gamma.
    Vector way(u), mean(v);
    way -= committed_u;
    const double at_end = scheme.gamma + scheme.alpha_m;
    const auto   work   = [&](const Vector &old, const Vector &now, const double theta) {
      mean = old;
      mean.sadd(1. - theta, theta, now);
      return mean * way;
    };
    Energies result = committed;
    if (damped)
      {
        Vector velocity(v);
        velocity.sadd(0.5, 0.5, end_v);
        damping_force(velocity, mean);
        result.damping += mean * way;
      }
    // What has no mass has no momentum to go on with: its velocity is that of the step.
    for (const Index node : massless)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const Index i = node + d;
          end_v(i)      = (u(i) - committed_u(i)) / step;
          end_a(i)      = 0.;
        }
    end_v.compress(VectorOperation::insert);
    end_a.compress(VectorOperation::insert);
    if (forces.velocity_constraints != nullptr)
      lose_rebound(forces, result);
    result.kinetic = kinetic_energy(end_v);
    result.strain  = solid.strain_energy(u);
    result.plastic = solid.dissipation();
    result.contact += forces.obstacles_normal - work(old_normal, *forces.normal, at_end);
    result.friction +=
      forces.obstacles_tangential - work(old_tangential, *forces.tangential, at_end);
    result.external += forces.obstacles_normal + forces.obstacles_tangential +
                       work(old_support, *forces.support, at_end) +
                       work(old_external, *forces.external, at_end - scheme.alpha_f);
    result.update_largest();
    return result;
  }



  void
  Dynamics::lose_rebound(const StepForces &forces, Energies &energies)
  {
    Impact             impact(*forces.velocity_constraints, mass, solid, forces.remove_support);
    const Impact::Loss of_acceleration = impact.stop(end_a, false);
    end_normal -= of_acceleration.normal;
    end_tangential -= of_acceleration.tangential;
    Vector             mean(end_v);
    const Impact::Loss loss = impact.stop(end_v, true);
    mean.sadd(0.5, 0.5, end_v);
    energies.contact += mean * loss.normal - loss.of_obstacles;
    energies.friction += mean * loss.tangential;
    energies.external -= loss.of_obstacles;
  }



  void
  Dynamics::commit(const Vector & /*u*/, const StepForces &forces, const Energies &end)
  {
    committed      = end;
    v              = end_v;
    a              = end_a;
    committed_time = time;
    keep(forces);
    old_normal     = end_normal;
    old_tangential = end_tangential;
  }



  void
  Dynamics::keep(const StepForces &forces)
  {
    old_external   = *forces.external;
    old_internal   = *forces.internal;
    old_normal     = *forces.normal;
    old_tangential = *forces.tangential;
    old_support    = *forces.support;
  }



  void
  Dynamics::adopt(const std::vector<Vector>       &rates,
                  const StepForces                &forces,
                  const std::vector<BodyMomentum> &before)
  {
    v = rates.front();
    a = rates.back();
    keep(forces);

    // Coarser cells cannot move as finer ones did. What they lack as a whole is a
    // rigid motion.
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
        motions.push_back(rigid_motion(k));
        const auto momenta = momenta_of(motions.back());
        for (unsigned int b = 0; b < before.size(); ++b)
          for (unsigned int i = 0; i < n; ++i)
            inertia[b](i, k) = numbers(momenta[b])(i);
      }
    const auto now = momenta_of(v);
    for (unsigned int b = 0; b < before.size(); ++b)
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



  std::vector<std::pair<std::string, Vector *>>
  Dynamics::state()
  {
    return {{"velocity", &v},
            {"acceleration", &a},
            {"external force", &old_external},
            {"internal force", &old_internal},
            {"normal contact force", &old_normal},
            {"tangential contact force", &old_tangential},
            {"support force", &old_support}};
  }



  Vector
  Dynamics::rigid_motion(const unsigned int k) const
  {
    Vector result(v);
    VectorTools::get_position_vector(solid.mapping, solid.dof_handler, result);
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
        result[body[i]].mass += mass.of_nodes().begin()[i];
        result[body[i]].linear += p;
        result[body[i]].angular += cross_product_3d(x, p);
      }
    for (BodyMomentum &sum : result)
      {
        sum.mass    = Utilities::MPI::sum(sum.mass, solid.communicator);
        sum.linear  = Utilities::MPI::sum(sum.linear, solid.communicator);
        sum.angular = Utilities::MPI::sum(sum.angular, solid.communicator);
      }
    return result;
  }
} // namespace Touchstone
