// SPDX-License-Identifier: LGPL-2.1-or-later
// The friction law of doc/extending.md, as the page has it: its derivative, and the
// force of a block that slides under uniform pressure, on one rank and two.

#include "../contrib/skeletons/pressure_dependent.cc"
#include "extending_support.h"
#include <cmath>
#include <iostream>

using namespace Touchstone;
using namespace dealii;

namespace
{
  const std::string scene = file_text("contrib/skeletons/pressure_dependent.prm");

  /** The derivative of the limit against central differences. */
  double
  worst_slope()
  {
    PressureDependent law;
    ParameterHandler  prm;
    law.declare(prm);
    prm.set("Coefficient", "0.3");
    prm.set("Coefficient at high pressure", "0.1");
    prm.set("Reference pressure", "10");
    prm.assert_that_entries_have_been_set();
    law.check("Friction");
    double worst = 0.;
    for (double force = 0.25; force < 200.; force *= 2.)
      {
        FrictionInput input;
        input.area         = 0.125;
        const double step  = 1e-5 * force;
        input.normal_force = force + step;
        const double above = law.limit(input).force;
        input.normal_force = force - step;
        const double below = law.limit(input).force;
        input.normal_force = force;
        worst = std::max(worst, std::abs((above - below) / (2. * step) - law.limit(input).slope));
      }
    return worst;
  }

  void
  refuse(const std::string &override)
  {
    try
      {
        run_scene(scene, "refused", {"Contact pair sole/Friction/" + override});
      }
    catch (const InputError &error)
      {
        say("  ", override, ": ", error.what());
      }
  }

  void
  slide(const std::string &name, const std::vector<std::string> &overrides)
  {
    const double     area = 2., pressure = 10.;
    const double     exact = area * pressure * (0.3 - 0.2 * std::tanh(1.));
    const RunSummary run   = run_scene(scene, name, overrides);
    const PairResult pair  = run.contact.at("sole");
    say("  ",
        name,
        run.converged ? "" : ", not converged",
        ": ",
        pair.slip,
        " of ",
        pair.active,
        " nodes slip, friction ",
        pair.force[0],
        bound(", error", std::abs(-pair.force[0] / exact - 1.), 1e-6),
        bound(", largest pressure: error", std::abs(pair.max_pressure / pressure - 1.), 1e-6),
        bound(", normal force: error", std::abs(pair.force[2] / (area * pressure) - 1.), 1e-6),
        bound(", across", std::abs(pair.force[1]) / exact, 1e-6),
        run.iterations.newton <= 20 ? "" : ", more than 20 iterations");
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  say("derivative of the limit", bound(": error", worst_slope(), 1e-8));
  say("what cannot be");
  refuse("Coefficient=-0.1");
  refuse("Coefficient at high pressure=-0.1");
  refuse("Reference pressure=0");
  say("a block that slides");
  for (const std::string enforcement :
       {"elimination", "lagrange multipliers", "augmented lagrange", "penalty"})
    for (const std::string friction : {"exact", "regularised"})
      if (enforcement != "penalty" || friction == "regularised")
        slide(enforcement + ", " + friction,
              {"Contact/Enforcement=" + enforcement, "Contact/Friction=" + friction});
  slide("Belos CG, lagged", {"Linear solver/Type=Belos CG"});
  slide("Belos GMRES", {"Linear solver/Type=Belos GMRES"});
  slide("finite sliding", {"Contact pair sole/Sliding=finite"});
  slide("pointwise", {"Contact pair sole/Pairing=pointwise"});
  slide("averaged", {"Contact pair sole/Pairing=averaged"});
  return 0;
}
