// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/convergence_watch.h>

#include <algorithm>
#include <cmath>
#include <string>

// Foresees the number of iterations of a Krylov method from the reduction of the residual so far,
// assuming that it goes on at the same rate, so that multigrid which converges badly is given up
// early and not after the maximum of iterations (doc/theory.md, section 8).
namespace Touchstone
{
  namespace
  {
    /** Iterations before the first judgement, and between judgements: the first ones say
     * little of those that follow. */
    constexpr unsigned int enough = 30, interval = 5;
  } // namespace



  ConvergenceWatch::ConvergenceWatch(const double tolerance, const double patience)
    : tolerance(tolerance)
    , limit(patience)
  {
  }



  // A factorisation costs as much as about n/130 iterations (measured, doc/benchmarks.md); at
  // least 75, as short iterations cost little, and at most 300.
  double
  ConvergenceWatch::patience(const int n_dofs)
  {
    return std::clamp(n_dofs / 130., 75., 300.);
  }



  bool
  ConvergenceWatch::wants_next() const
  {
    return limit < endless && n_residuals % interval == 0;
  }



  void
  ConvergenceWatch::next(const double residual)
  {
    const bool wanted = wants_next();
    ++n_residuals;
    if (!wanted)
      return;
    if (iterations() == 0)
      first = smallest = residual;
    // The smallest residual, since that of conjugate gradients oscillates.
    smallest = std::min(smallest, residual);
    if (iterations() < enough)
      return;
    // Natural logarithms of the reductions reached and wanted; their ratio scales the iterations.
    const double digits = -std::log(smallest / first);
    const double expected =
      digits > 0. ? iterations() * std::log(1. / tolerance) / digits : endless;
    if (expected > limit)
      throw SlowConvergence(
        "multigrid would take " +
        (expected < 1e4 ? "about " + std::to_string(std::lround(expected / 10.) * 10)
                        : std::string("more than 10,000")) +
        " iterations; bodies may be nearly incompressible, slender or almost free");
  }
} // namespace Touchstone
