// The skeletons of contrib/skeletons compile and work: a friction law, a pairing
// and an enforcement, and the other samples of doc/extending.md. Those that scenes
// cannot name run in the place of a built-in one.

#include "../contrib/skeletons/enforcement.cc"
#include "../contrib/skeletons/friction_law.cc"
#include "../contrib/skeletons/geometry.cc"
#include "../contrib/skeletons/linear_solver.cc"
#include "../contrib/skeletons/pairing.cc"
#include "../contrib/skeletons/reference_solution.cc"
#include "extending_support.h"

using namespace Touchstone;

namespace
{
  /** While it lives, @p own runs where scenes name @p built_in. */
  template <class Registry>
  class InPlaceOf
  {
  public:
    InPlaceOf(const std::string &built_in, const std::string &own)
      : name(built_in)
      , record(Registry::records().at(built_in))
    {
      Registry::records()[name] = Registry::records().at(own);
    }

    ~InPlaceOf()
    {
      Registry::records()[name] = record;
    }

  private:
    const std::string               name;
    const typename Registry::Record record;
  };

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
  slide(const std::string &name, const std::string &law)
  {
    const RunSummary run = run_scene(sliding_block(law), name, {});
    say("  ",
        name,
        run.converged ? "" : ", not converged",
        ": ",
        run.contact.at("sole").slip,
        " nodes slip",
        bound(", error of the force", run.errors.at("total_force"), 1e-6),
        run.iterations.newton <= 30 ? "" : ", more than 30 iterations");
  }

  /** Largest relative difference of force, area and pressure of the first pair. */
  double
  difference(const RunSummary &run, const RunSummary &other)
  {
    const PairResult a = run.contact.begin()->second, b = other.contact.begin()->second;
    return std::max({(a.force - b.force).norm() / b.force.norm(),
                     std::abs(a.area / b.area - 1.),
                     std::abs(a.max_pressure / b.max_pressure - 1.)});
  }

  template <class Registry>
  void
  compare(const std::string              &scene,
          const std::string              &built_in,
          const std::string              &own,
          const std::vector<std::string> &overrides = {})
  {
    const std::string         text  = file_text("tests/" + scene + ".prm");
    const RunSummary          right = run_scene(text, scene, overrides);
    const InPlaceOf<Registry> exchange(built_in, own);
    const RunSummary          run = run_scene(text, scene, overrides);
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
  compare<PairingRegistry>("patch_matching", "pointwise", "node to node");
  say("enforcement");
  {
    const InPlaceOf<EnforcementRegistry> exchange("elimination", "simple augmented lagrange");
    slide("friction", "coulomb");
  }
  for (const std::string scene : {"small_sliding", "tied_shear", "sphere_obstacle"})
    compare<EnforcementRegistry>(scene, "elimination", "simple augmented lagrange");
  say("geometry and reference solution");
