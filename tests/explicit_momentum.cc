// SPDX-License-Identifier: LGPL-2.1-or-later
// Two spinning blocks hit each other off centre with friction, part and fly on: momentum and moment
// of momentum stay what they were, for pointwise and averaged rows, and energy does not grow. With
// an argument the number of output intervals of 50 cycles (doc/explicit.md).

#include <touchstone/drive/step.h>
#include <touchstone/scene/scene.h>

#include "mesh_common.h"
#include <algorithm>
#include <cstdlib>

using namespace Touchstone;
using namespace dealii;

namespace
{
  const std::string blocks = R"(
set Bodies        = first, second
set Contact pairs = pair
subsection Body first
  set Initial velocity x = 1 - 3 * y
  set Initial velocity y = 3 * (x + 0.5)
  set Element = full
  subsection Geometry
    set Lower corner = -1.01, -0.5, -0.5
    set Upper corner = -0.01, 0.5, 0.5
    set Cells        = 3, 3, 3
  end
  subsection Material
    set Law           = neo-Hookean
    set Young modulus = 1000
    set Poisson ratio = 0.3
    set Density       = 1
  end
end
subsection Body second
  set Initial velocity x = -1
  set Initial velocity z = 2 * (y - 0.7)
  set Initial velocity y = -2 * (z - 0.2)
  set Element = full
  subsection Geometry
    set Lower corner = 0, 0.1, -0.3
    set Upper corner = 1, 1.1, 0.7
    set Cells        = 4, 4, 4
  end
  subsection Material
    set Law           = neo-Hookean
    set Young modulus = 500
    set Poisson ratio = 0.2
    set Density       = 2
  end
end
subsection Contact pair pair
  set Slave body        = first
  set Slave boundaries  = right, back, top
  set Master body       = second
  set Master boundaries = left, front, bottom
  set Behaviour         = coulomb
  subsection Friction
    set Coefficient = 0.4
  end
end
subsection Time integration
  set Scheme                   = central_differences
  set Linear bulk viscosity    = 0
  set Quadratic bulk viscosity = 0
end
)";

  struct Sum
  {
    Tensor<1, dim> linear, angular;
  };

  Sum
  momenta(const Step &step)
  {
    Sum sum;
    for (const BodyMomentum &body : step.state().time_integration.momenta())
      {
        sum.linear += body.linear;
        sum.angular += body.angular;
      }
    return sum;
  }

  void
  fly(const std::string &name, const std::vector<std::string> &overrides, const unsigned int n)
  {
    const Scene        scene(blocks, "scene.prm", overrides);
    const Forest       forest(scene.forest_input(), "", MPI_COMM_WORLD);
    Solid              solid(scene.bodies, 1, forest, MPI_COMM_WORLD);
    ConditionalOStream nowhere(std::cout, false);
    TimerOutput        timer(nowhere, TimerOutput::never, TimerOutput::wall_times);
    const auto         step = Step::make(scene, forest, solid, timer);
    step->start();
    const Sum    before = momenta(*step);
    double       drift = 0., turn = 0., force = 0.;
    unsigned int cycles = 0, most_active = 0;
    for (unsigned int i = 1; i <= n; ++i)
      {
        step->solve(0.2 * i, scene.newton, {});
        step->commit();
        const Sum now = momenta(*step);
        // Momenta of either body are about 1.
        drift = std::max(drift, (now.linear - before.linear).norm());
        turn  = std::max(turn, (now.angular - before.angular).norm());
        cycles += step->cycle_counts()->cycles;
        unsigned int active = 0;
        for (const ContactRow &row : step->state().contact.rows())
          if (step->state().contact.state(row).active())
            {
              ++active;
              force = std::max(force, step->state().contact.state(row).lambda);
            }
        most_active = std::max(most_active, Utilities::MPI::max(active, MPI_COMM_WORLD));
      }
    const Energies &energies = step->state().time_integration.committed_energies();
    const double    gain     = energies.gain() / energies.initial;
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        std::cout << name << "\n  in contact      " << (most_active > 0 ? "yes" : "no FAILED")
                  << "\n  momentum        " << small(drift, 1e-13) << "\n  moment          "
                  << small(turn, 1e-12) << "\n  friction took   "
                  << (energies.friction > 1e-3 ? "yes" : "no FAILED") << "\n  contact gave    "
                  << small(std::max(0., -energies.contact) / energies.initial, 1e-6)
                  << "\n  balance error   "
                  << small(std::abs(energies.balance_error()) / energies.initial, 1e-3)
                  << std::endl;
        if (std::getenv("SHOW"))
          std::cout << cycles << " cycles, momentum " << drift << ", moment " << turn
                    << ", friction " << energies.friction << ", contact " << energies.contact
                    << ", gain " << gain << ", balance " << energies.balance_error() << " of "
                    << energies.initial << ", rows " << most_active << std::endl;
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int               n = argc > 1 ? std::atoi(argv[1]) : 8;
  fly("averaged", {}, n);
  fly("pointwise", {"Contact pair pair/Pairing=pointwise"}, n);
  return 0;
}
