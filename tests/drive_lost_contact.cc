// SPDX-License-Identifier: LGPL-2.1-or-later
// A body that nothing but contact holds, and that a bad iterate has thrown off: without loads it
// is in balance wherever it is, so that Newton takes the place for a solution. The step must end
// with the reason. A body that stays near what it touched is a warning, and one that still
// touches it nothing at all.

#include <touchstone/base/non_convergence.h>

#include "drive_support.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  const std::string block_on_plane = R"(
set Bodies        = block
set Obstacles     = ground
set Contact pairs = contact
subsection Body block
  set Boundary conditions = top
  subsection Geometry
    set Type  = box
    set Cells = 2, 2, 2
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.3
  end
  subsection Boundary top
    set Traction z = t < 0.5 ? -10 * t : t < 0.9 ? 1e4 * (t - 0.5) : t < 1.5 ? 0 : -10
  end
end
subsection Obstacle ground
  set Shape     = plane
  set Direction = 0, 0, 1
end
subsection Contact pair contact
  set Slave body       = block
  set Slave boundaries = bottom
  set Obstacle         = ground
end
)";

  /** Press, be torn off by a load that no step has, and go to @p time, when there is none any
   * more (1) or the block is pressed again (2). */
  void
  print_end(const std::string &title, const double detour, const double time)
  {
    Run run(block_on_plane, {}, MPI_COMM_WORLD);
    run.solve(run.scene.newton, 0.25);
    run.problem.commit();
    if (detour > 0.)
      try
        {
          NewtonParameters hasty   = run.scene.newton;
          hasty.maximum_iterations = 2;
          run.solve(hasty, detour);
        }
      catch (const NonConvergence &)
        {
        }
    std::cout << title << ": ";
    try
      {
        run.solve(run.scene.newton, time);
        const auto warnings = run.problem.findings().warnings;
        std::cout << (warnings.empty() ? "no warning" : warnings.front());
      }
    catch (const LostContact &error)
      {
        // Without the distance, which the stabilisation decides.
        const std::string text = error.what();
        std::cout << "lost contact: " << text.substr(0, text.find(", by ")) << ','
                  << text.substr(text.find(": nothing") + 1);
      }
    catch (const NonConvergence &error)
      {
        std::cout << "not converged: " << error.what();
      }
    std::cout << std::endl;
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  print_end("pressed again", 0., 2.);
  print_end("torn off, no load", 0.8, 1.);
  return 0;
}
