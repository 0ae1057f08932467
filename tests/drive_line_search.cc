// SPDX-License-Identifier: LGPL-2.1-or-later
// The line search of Newton's method on equations of one unknown, whose residuals and
// active sets are known: a method that behaves costs no evaluation more, an increment
// that makes things much worse is shortened, and a residual that a change of the active
// set or a support on its way has raised shortens nothing. Increments that oscillate
// come to rest between.

#include <touchstone/base/non_convergence.h>
#include <touchstone/drive/newton.h>

#include <cmath>
#include <functional>
#include <iostream>

using namespace Touchstone;

namespace
{
  /** f(x) = 0; what else a state is made of, by the number of solves before. */
  struct Equation : public NonlinearProblem
  {
    using Function = std::function<double(double)>;

    Function     f, slope;
    double       x, before = 0., increment = 0.;
    unsigned int evaluations = 0, solves = 0, shortened = 0;
    /** Rows that change and supports on their way at solve k. */
    std::function<bool(unsigned int)> changes = [](unsigned int) { return false; };
    std::function<bool(unsigned int)> moves   = [](unsigned int) { return false; };

    Equation(const Function &f, const Function &slope, const double start)
      : f(f)
      , slope(slope)
      , x(start)
    {
    }

    NewtonState
    residual(unsigned int) override
    {
      ++evaluations;
      NewtonState state;
      state.force = state.residual = std::abs(f(x));
      state.prescribed             = !moves(solves);
      state.changes                = changes(solves);
      state.signature              = state.changes ? solves : 1000;
      return state;
    }
    void
    linearize() override
    {
      increment = -f(x) / slope(x);
    }
    int
    solve() override
    {
      ++solves;
      return -1;
    }
    void
    update() override
    {
      before = x;
      x += increment;
    }
    void
    shorten(const double fraction) override
    {
      ++shortened;
      x = before + fraction * increment;
    }
  };



  void
  run(const std::string &name, Equation equation, const std::string &line_search)
  {
    NewtonParameters parameters;
    parameters.line_search = line_search;
    unsigned int damped    = 0;
    std::cout << name << ", line search " << line_search << ": ";
    try
      {
        const unsigned int iterations =
          Newton(parameters).solve(equation, [&](unsigned int, const NewtonState &state, int) {
            damped += (state.fraction < 1.);
          });
        std::cout << iterations << " iterations, " << damped << " damped, "
                  << equation.evaluations - iterations - 1
                  << " evaluations more, x = " << equation.x << std::endl;
      }
    catch (const NonConvergence &)
      {
        std::cout << "no convergence, " << damped << " damped" << std::endl;
      }
  }
} // namespace



int
main()
{
  const auto cubic       = [](double x) { return x + x * x * x - 10.; };
  const auto cubic_slope = [](double x) { return 1. + 3. * x * x; };
  // A tangent seven times too soft: each full increment makes the force six times larger.
  const auto linear = [](double x) { return x - 1.; };
  const auto soft   = [](double x) { return std::abs(x - 1.) < 1. ? 1. : 0.15; };
  // The same, but so far away that all is well again.
  const auto wild = [=](double x) { return std::abs(x - 1.) > 200. ? 1. : soft(x); };

  // Full increments lead to the other side of the solution, as far away.
  const auto root = [](double x) { return std::copysign(std::sqrt(std::abs(x - 1.)), x - 1.); };
  const auto root_slope = [](double x) { return 0.5 / std::sqrt(std::abs(x - 1.)); };

  for (const std::string search : {"automatic", "none"})
    {
      run("well-behaved", Equation(cubic, cubic_slope, 3.), search);
      run("increments too long", Equation(linear, soft, 3.), search);
      run("increments oscillate", Equation(root, root_slope, 3.), search);

      Equation changing(linear, wild, 3.);
      changing.changes = [](unsigned int solves) { return solves < 4; };
      run("the active set changes", changing, search);

      Equation moving(linear, wild, 3.);
      moving.moves = [](unsigned int solves) { return solves < 3; };
      run("supports move", moving, search);

      // Uphill on all parts of an increment: all of it is taken.
      const auto uphill = [](double x) { return std::abs(x - 1.) > 30. ? 1. : -0.2; };
      run("a wrong direction", Equation(linear, uphill, 2.), search);
    }
  return 0;
}
