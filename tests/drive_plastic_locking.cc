// SPDX-License-Identifier: LGPL-2.1-or-later
// Plastic flow keeps the volume: a block between rough platens in plane strain, perfectly
// plastic, is pressed far beyond yield. The force that degree 2 finds is met by b-bar and
// F-bar cells of degree 1 and exceeded by full ones, which lock.

#include "drive_support.h"
#include <iomanip>

using namespace Touchstone;
using namespace dealii;

namespace
{
  const std::string text = R"(
set Bodies = block
subsection Body block
  set Symmetry = left, front, back, bottom
  set Boundary conditions = top
  subsection Geometry
    set Type         = box
    set Upper corner = 2, 0.25, 1
    set Cells        = 8, 1, 4
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.3
    subsection Plasticity
      set Yield stress = 2
    end
  end
  subsection Boundary top
    set Displacement x = 0
    set Displacement z = -0.04 * t
  end
end
subsection Load stepping
  set Steps = 16
end
)";

  double
  force(const std::string &law, const std::string &element, const std::string &degree)
  {
    Run run(text,
            {"Body block/Material/Law=" + law,
             "Body block/Element=" + element,
             "Discretisation/Degree=" + degree},
            MPI_COMM_WORLD);
    run.solve_steps();
    for (const Reaction &reaction : run.problem.state().reactions())
      if (reaction.boundary == "top")
        return -reaction.force[2];
    return 0.;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string law : {"small-strain von Mises", "finite-strain von Mises"})
    {
      const double best = force(law, "automatic", "2");
      const double bar  = force(law, "automatic", "1") / best - 1.;
      const double full = force(law, "full", "1") / best - 1.;
      std::cout << law << ": mean pressure over the yield stress of plane strain "
                << std::setprecision(3) << best / (2. * 0.25) / (2. * 2. / std::sqrt(3.))
                << ", automatic of degree 1 " << (std::abs(bar) < 0.02 ? "agrees" : "DIFFERS")
                << ", full of degree 1 " << (full > 0.05 ? "locks" : "DOES NOT LOCK") << std::endl;
    }
  return 0;
}
