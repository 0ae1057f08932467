// SPDX-License-Identifier: LGPL-2.1-or-later
// Hill's tube: equilibrium, yield limit and boundary values of the stress, the
// plastic radius against its formula, the core against Lame's solution, and bad
// values. Radii and stresses were computed by hand from the formulae.

#include <touchstone/verification/hill_tube.h>

#include <cmath>
#include <iomanip>
#include <iostream>

using namespace Touchstone;

namespace
{
  const std::string tube =
    "inner radius: 1, outer radius: 2, young modulus: 210000, poisson ratio: 0.5, yield stress: "
    "173.20508075688772, ";
  const std::string core =
    "core inner radius: 0.5, core young modulus: 210000, core poisson ratio: 0.5, ";

  HillTube
  make(const std::string &values)
  {
    return HillTube(ReferenceValues(values), 0);
  }

  void
  attempt(const std::string &values)
  {
    try
      {
        make(values);
        std::cout << "accepted" << std::endl;
      }
    catch (const std::exception &error)
      {
        std::cout << error.what() << std::endl;
      }
  }

  void
  report(const std::string &what, const double error)
  {
    std::cout << what << (std::abs(error) < 1e-6 ? " < 1e-6" : " is wrong") << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::cout << std::setprecision(8);

  // k = 100; c = 1.5 at p/k = 1 - 2.25/4 + 2 ln 1.5.
  const HillTube plain    = make(tube.substr(0, tube.size() - 2));
  const double   pressure = 100. * (1. - 2.25 / 4. + 2. * std::log(1.5));
  report("c(p) - 1.5", plain.plastic_radius(pressure) - 1.5);
  report("c below the yield limit - a", plain.plastic_radius(74.) - 1.);

  for (const double p : {50., pressure})
    for (const double now : {p, 0.4 * p, 0.})
      {
        double equilibrium = 0., yield = 0.;
        for (double r = 1.005; r < 2.; r += 0.01)
          {
            const double           h = 1e-5;
            const HillTube::Stress s = plain.stress(r, p, now);
            equilibrium              = std::max(equilibrium,
                                   std::abs((plain.stress(r + h, p, now).radial -
                                             plain.stress(r - h, p, now).radial) /
                                              (2. * h) -
                                            (s.hoop - s.radial) / r));
            yield                    = std::max(yield, std::abs(s.hoop - s.radial) / 200.);
          }
        std::cout << "peak " << p << ", now " << now << ": yield limit used " << yield << '\n';
        report("  equilibrium", equilibrium * 1e-3);
        report("  radial stress at the bore + p", plain.stress(1., p, now).radial + now);
        report("  radial stress outside", plain.stress(2., p, now).radial);
      }
  std::cout << "residual hoop stress at the bore " << plain.stress(1., pressure, 0.).hoop << '\n';

  // Of an incompressible core, P - p = 2 G (C/a_i^2 - C/a^2) with C = k c^2/(2G): 675.
  report("core pressure - p - 675",
         make(tube + core + "core peak pressure: 700").core_pressure(pressure) - pressure - 675.);
  report(
    "peak of that core - p",
    make(tube + core + "core peak pressure: " + std::to_string(pressure + 675.)).peak_pressure() -
      pressure);

  attempt(tube + "outer radius: 3");
  attempt(tube + "peak pressure: 140");
  attempt(tube + "unloaded: 1");
  attempt(tube + core + "core peak pressure: 2000");
  attempt(tube + core + "core peak pressure: 500, peak pressure: 100");
  attempt(tube + "core inner radius: 0.5, core peak pressure: 500");
  attempt("inner radius: 1, outer radius: 3, young modulus: 1, poisson ratio: 0.5, yield stress: "
          "1, peak pressure: 1.1, unloaded: 1");
  attempt("inner radius: 1, outer radius: 2, young modulus: 1, poisson ratio: 0.3, yield stress: "
          "1");
  return 0;
}
