// SPDX-License-Identifier: LGPL-2.1-or-later
// Impact without rebound, on two blocks that press on each other, stick and slide: what it
// takes from any field of velocities.

#include <touchstone/drive/impact.h>
#include <touchstone/solid/bodies.h>

#include <deal.II/numerics/vector_tools_interpolate.h>

#include "contact_support.h"
#include "drive_support.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  using Vec = Touchstone::Vector;

  /** A velocity of each node that has nothing to do with those of others. */
  Vec
  scattered_velocity(const Solid &solid)
  {
    Vec positions(solid.owned, solid.communicator), v(positions);
    VectorTools::get_position_vector(solid.mapping, solid.dof_handler, positions);
    for (std::size_t k = 0; k < v.locally_owned_size(); k += dim)
      {
        const Point<dim> x(positions.begin()[k],
                           positions.begin()[k + 1],
                           positions.begin()[k + 2]);
        for (unsigned int d = 0; d < dim; ++d)
          v.begin()[k + d] = scattered(x, 1)[d];
      }
    return v;
  }



  double
  kinetic_energy(const Mass &mass, const Vec &velocity)
  {
    Vec momentum(velocity);
    mass.multiply(velocity, momentum);
    return 0.5 * (momentum * velocity);
  }



  Tensor<1, dim>
  momentum_of(const unsigned int body, const Mass &mass, const Solid &solid, const Vec &velocity)
  {
    const std::vector<unsigned int> bodies = bodies_of_unknowns(solid);
    Vec                             product(velocity);
    mass.multiply(velocity, product);
    Tensor<1, dim> sum;
    for (std::size_t k = 0; k < product.locally_owned_size(); ++k)
      if (bodies[k] == body)
        sum[k % dim] += product.begin()[k];
    return Utilities::MPI::sum(sum, solid.communicator);
  }



  /** By how much velocities miss what the conditions ask for. */
  double
  missed_velocity(const std::vector<VelocityConstraint> &constraints,
                  const Solid                           &solid,
                  const Vec                             &v)
  {
    IndexSet needed = solid.relevant;
    for (const VelocityConstraint &node : constraints)
      for (const auto &[at, coefficients] : node.condition.motion_form())
        needed.add_range(dim * at, dim * at + dim);
    needed.compress();
    Vec ghosted(solid.owned, needed, solid.communicator);
    ghosted       = v;
    double missed = 0.;
    for (const VelocityConstraint &node : constraints)
      {
        double speed = 0.;
        for (const auto &[at, coefficients] : node.condition.motion_form())
          for (unsigned int d = 0; d < dim; ++d)
            speed += coefficients[d] * ghosted(dim * at + d);
        missed = std::max(missed, std::abs(speed - node.condition.value));
      }
    return Utilities::MPI::max(missed, solid.communicator);
  }



  void
  impact(const std::string &title, const std::vector<std::string> &overrides)
  {
    std::vector<std::string> all = overrides;
    all.push_back("Body base/Material/Density=1e-3");
    all.push_back("Body block/Material/Density=1e3");
    Run run(blocks, all, MPI_COMM_WORLD);
    run.solve(run.scene.newton, 0.8);
    const Solid                    &solid = run.solid;
    std::vector<VelocityConstraint> constraints =
      velocity_constraints(run.problem.state().contact, ConstraintGraph(), 0.8, 0.1);
    unsigned int sliding = 0, across = 0;
    for (VelocityConstraint &node : constraints)
      {
        node.condition.value = node.normal ? 0.3 : 0.2;
        sliding += node.condition.force_direction.norm_square() > 0.;
        across += !node.normal;
      }
    const Mass         mass(run.scene.time_integration.mass, solid, {}, 0.1);
    Impact             impact(constraints, mass, solid, [](Vec &) {});
    Vec                v = scattered_velocity(solid);
    const Vec          before(v);
    const Impact::Loss loss = impact.stop(v, true);
    Vec                mean(before);
    mean.sadd(0.5, 0.5, v);

    // The velocities that are left are those that the conditions ask for.
    const double   missed   = missed_velocity(constraints, solid, v);
    double         impulses = 0.;
    Tensor<1, dim> impulse;
    for (const VelocityConstraint &node : constraints)
      {
        impulses += std::abs(node.impulse);
        impulse += node.impulse * node.condition.force();
      }
    impulses = Utilities::MPI::sum(impulses, solid.communicator);
    sliding  = Utilities::MPI::sum(sliding, solid.communicator);
    across   = Utilities::MPI::sum(across, solid.communicator);

    const double energy = kinetic_energy(mass, before), lost = energy - kinetic_energy(mass, v),
                 work = mean * loss.normal + mean * loss.tangential;
    // The block gets the impulses along their directions, the base the opposite.
    impulse       = Utilities::MPI::sum(impulse, solid.communicator);
    double change = 0.;
    for (const unsigned int of : {0, 1})
      change = std::max(change,
                        (momentum_of(of, mass, solid, v) - momentum_of(of, mass, solid, before) +
                         (of == 1 ? 1. : -1.) * impulse)
                            .norm() /
                          impulses);
    // What has been taken is gone: nothing is left for a second time.
    Vec again(v);
    impact.stop(again, true);
    again -= v;
    const double rest = again.linfty_norm();
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << title << ": " << sliding << " sliding, " << across
                << " conditions across; velocities missed " << small(missed, 1e-9)
                << ", momenta less impulses " << small(change, 1e-10)
                << ", loss of kinetic energy less "
                << "the work of impulses " << small((lost - work) / energy, 1e-12)
                << ", taken again " << small(rest, 1e-9) << (impulses > 0. ? "" : ", NO IMPULSE")
                << std::endl;
    if (std::getenv("IMPACT_VERBOSE"))
      std::cout << missed << ' ' << change << ' ' << (lost - work) / energy << ' ' << rest << ' '
                << lost / energy << std::endl;
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string mass : {"lumped", "consistent"})
    for (const std::string pairing : {"pointwise", "averaged"})
      for (const std::string coefficient : {"0.3", "5"})
        impact(mass + ", " + pairing + ", friction " + coefficient,
               {"Time integration/Mass=" + mass,
                "Contact pair contact/Pairing=" + pairing,
                "Contact pair contact/Friction/Coefficient=" + coefficient});
  for (const std::string mass : {"lumped", "consistent"})
    impact(mass + ", no friction",
           {"Time integration/Mass=" + mass, "Contact pair contact/Friction/Coefficient=0"});
  return 0;
}
