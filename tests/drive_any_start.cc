// SPDX-License-Identifier: LGPL-2.1-or-later
// The converged state of a step does not depend on the iterates: each step is made once from the
// state before, and once from the displacements, forces and states of rows that an attempt at
// another load has left after two iterations. With friction, rows that come into contact within
// the step, stick and slip; exact enforcements, both pairings.

#include <touchstone/base/non_convergence.h>

#include "drive_support.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** Displacements and tractions after three steps. */
  std::vector<double>
  final_state(const std::vector<std::string> &overrides, const double detour)
  {
    Run run(blocks, overrides, MPI_COMM_WORLD);
    for (unsigned int step = 1; step <= 3; ++step)
      {
        if (detour != 0.)
          try
            {
              NewtonParameters hasty   = run.scene.newton;
              hasty.maximum_iterations = 1;
              run.solve(hasty, 0.5 * (step + detour));
            }
          catch (const NonConvergence &)
            {
            }
        run.solve(run.scene.newton, 0.5 * step);
        run.problem.commit();
      }
    const auto         &u = run.problem.state().displacement;
    std::vector<double> result(u.begin(), u.end());
    for (const ContactPoint &point : contact_points(run.problem.state().contact, u))
      for (unsigned int d = 0; d < dim; ++d)
        result.push_back(point.traction[d] / 1000.);
    return result;
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string pairing : {"averaged", "pointwise"})
    for (const std::string enforcement :
         {"elimination", "lagrange multipliers", "augmented lagrange"})
      {
        const std::vector<std::string> overrides  = {"Contact/Enforcement=" + enforcement,
                                                     "Contact pair contact/Pairing=" + pairing,
                                                     "Newton/Residual tolerance=1e-12",
                                                     "Newton/Gap tolerance=1e-10"};
        const std::vector<double>      plain      = final_state(overrides, 0.);
        double                         difference = 0.;
        for (const double detour : {-0.4, 0.3, 0.8})
          {
            const std::vector<double> other = final_state(overrides, detour + 1e-9);
            for (std::size_t k = 0; k < plain.size(); ++k)
              difference = std::max(difference, std::abs(plain[k] - other[k]));
          }
        difference = Utilities::MPI::max(difference, MPI_COMM_WORLD);
        if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
          {
            std::cout << pairing << ", " << enforcement;
            print_agreement(difference, 1e-8);
          }
      }
  return 0;
}
