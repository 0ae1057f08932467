// SPDX-License-Identifier: LGPL-2.1-or-later
// The skeletons of contrib/skeletons compile and work: scenes name them as they name built-in
// classes. extending_plugins.cc has more of them.

#include "../contrib/skeletons/enforcement.cc"
#include "../contrib/skeletons/friction_law.cc"
#include "../contrib/skeletons/geometry.cc"
#include "../contrib/skeletons/linear_solver.cc"
#include "../contrib/skeletons/pairing.cc"
#include "../contrib/skeletons/preconditioner.cc"
#include "../contrib/skeletons/reference_solution.cc"
#include "extending_support.h"
#include <cmath>

using namespace Touchstone;

namespace
{
  std::string
  replaced(std::string text, const std::string &what, const std::string &by)
  {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at))
      {
        text.replace(at, what.size(), by);
        at += by.size();
      }
    return text;
  }

  /** The block of the friction law's page, with a constant coefficient. */
  std::string
  sliding_block(const std::string &law)
  {
    std::string text = file_text("contrib/skeletons/pressure_dependent.prm");
    text             = replaced(text, "(0.3 - 0.2 * tanh(10 / 10))", "0.3");
    text             = replaced(text, "set Coefficient at high pressure", "#");
    text             = replaced(text, "set Reference pressure", "#");
    text             = replaced(text, "pressure dependent", law);
    return text +
           "subsection Reference solution\n  set Type = total force\n  set Values = force: " +
           std::to_string(20. * std::sqrt(1. + 0.09)) + "\nend\n";
  }

  void
  slide(const std::string              &name,
        const std::string              &law,
        const std::vector<std::string> &overrides = {})
  {
    const RunSummary run = run_scene(sliding_block(law), name, overrides);
    say("  ",
        name,
        run.converged ? "" : ", not converged",
        ": ",
        run.contact.at("sole").slip,
        " nodes slip",
        bound(", error of the force", run.errors.at("total_force"), 1e-6),
        run.iterations.newton <= 30 ? "" : ", more than 30 iterations");
  }

  /** Largest difference of force, area and pressure of the first pair, over the
   * force and what it is per area. */
  double
  difference(const RunSummary &run, const RunSummary &other)
  {
    const PairResult a = run.contact.begin()->second, b = other.contact.begin()->second;
    return std::max({(a.force - b.force).norm() / b.force.norm(),
                     std::abs(a.area / b.area - 1.),
                     std::abs(a.max_pressure - b.max_pressure) / (b.force.norm() / b.area)});
  }

  /** Run a scene as it is, and with @p key set to the class of a skeleton. */
  void
  compare_with(const std::string              &scene,
               const std::string              &key,
               const std::string              &own,
               const std::vector<std::string> &overrides = {})
  {
    const std::string        text  = file_text("tests/" + scene + ".prm");
    const RunSummary         right = run_scene(text, scene, overrides);
    std::vector<std::string> all   = overrides;
    all.push_back(key + "=" + own);
    const RunSummary run = run_scene(text, scene, all);
    say("  ",
        own,
        " in ",
        scene,
        run.converged ? "" : ", not converged",
        bound(": difference", difference(run, right), 1e-6));
  }

  const std::string wedge_scene = R"(
set Bodies        = wedge
set Obstacles     = floor
set Contact pairs = sole
subsection Body wedge
  set Symmetry            = left, front
  set Boundary conditions = top
  subsection Boundary top
    set Pressure = 4
  end
  subsection Geometry
    set Type  = wedge
    set Slope = 0.5
    set Cells = 3, 2, 2
  end
  subsection Material
    set Young modulus = 1000
  end
end
subsection Obstacle floor
end
subsection Contact pair sole
  set Slave body       = wedge
  set Slave boundaries = bottom
  set Obstacle         = floor
end
subsection Reference solution
  set Type   = total force
  set Values = force: 4
end
)";
} // namespace



int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  say("friction law");
  slide("my friction law", "my friction law");
  say("pairing");
  compare_with("patch_matching", "Contact pair interface/Pairing", "node to node");
  say("enforcement");
  slide("friction", "coulomb", {"Contact/Enforcement=simple augmented lagrange"});
  for (const std::string scene : {"small_sliding", "tied_shear", "sphere_obstacle"})
    compare_with(scene, "Contact/Enforcement", "simple augmented lagrange");
  say("geometry and reference solution");
  const RunSummary run = run_scene(wedge_scene, "wedge", {});
  say("  wedge", bound(": error of the force", run.errors.at("total_force"), 1e-6));
  say("linear solver");
  compare_with("small_sliding", "Linear solver/Type", "KLU");
  say("preconditioner");
  compare_with("small_sliding",
               "Linear solver/Preconditioner",
               "incomplete LU",
               {"Linear solver/Type=Belos GMRES"});
  return 0;
}
