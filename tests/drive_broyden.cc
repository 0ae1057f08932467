// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/broyden.h>

#include <cmath>
#include <iostream>

// Broyden's method for a few unknowns: springs that stiffen and are coupled, with a first guess of
// the stiffness that is ten times too small or too large; and a direction without stiffness, which
// finite differences find.

using namespace Touchstone;

namespace
{
  /** Forces of springs along x, y and z, less those that are to be in balance. */
  Broyden::Numbers
  residual(const Broyden::Numbers &x, const bool third)
  {
    return {100. * x[0] + 40. * x[1] + 3e3 * std::pow(x[0], 3) - 5.,
            40. * x[0] + 60. * x[1] + 2. * x[2] - 1.,
            third ? 2. * x[1] + 20. * x[2] + 3. : 2. * x[1] - 7.};
  }

  void
  solve(const double guess)
  {
    Broyden broyden;
    broyden.begin({0., 0., 0.});
    double missing = 1.;
    while (missing > 1e-10 && broyden.n_changes() < 60)
      {
        const Broyden::Numbers r = residual(broyden.x(), true);
        missing                  = std::hypot(r[0], r[1], r[2]) / 5.;
        if (broyden.advance(r, {{guess, guess, guess}, 5., 0.5}))
          std::cout << "a direction without stiffness that there is not" << std::endl;
      }
    std::cout << "stiffness guessed as " << guess << ": " << (missing <= 1e-10 ? "" : "not ")
              << "found, " << (broyden.n_changes() < 40 ? "fewer" : "more") << " than 40 states"
              << std::endl;
  }
} // namespace



int
main()
{
  solve(10.);
  solve(60.);
  solve(600.);
  // z does not matter here, and the forces are in balance nowhere.
  Broyden broyden;
  broyden.begin({0., 0., 0.});
  while (broyden.n_changes() < 60)
    if (const auto direction =
          broyden.advance(residual({broyden.x()[0], broyden.x()[1], 0.}, false),
                          {{60., 60., 60.}, 7., 0.5}))
      {
        std::cout << "no stiffness along " << std::abs(std::round((*direction)[0])) << ", "
                  << std::abs(std::round((*direction)[1])) << ", "
                  << std::abs(std::round((*direction)[2])) << std::endl;
        return 0;
      }
  std::cout << "the direction was not found" << std::endl;
  return 0;
}
