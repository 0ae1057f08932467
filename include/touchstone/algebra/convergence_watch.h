// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_convergence_watch_h
#define touchstone_algebra_convergence_watch_h

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace Touchstone
{
  /** @brief An iteration would take more steps than its solution is worth. */
  class SlowConvergence : public std::runtime_error
  {
    using std::runtime_error::runtime_error;
  };

  /** @brief Whether a preconditioner that was made for an earlier system is worth a new set-up: its
   * solve has taken a quarter more iterations, and two at least, than its first one took. */
  inline bool
  wants_new_set_up(const int iterations, const int first)
  {
    return iterations > std::max(first * 5 / 4, first + 2);
  }

  /**
   * @brief Extrapolates from the residuals of an iteration how many steps it would take.
   *
   * Residuals are the same on all ranks, and so is what is thrown.
   */
  class ConvergenceWatch
  {
  public:
    static constexpr double endless = std::numeric_limits<double>::max();

    /**
     * @param tolerance Relative residual that is asked for; no unit.
     * @param patience  Iterations that may be taken; endless: any.
     */
    ConvergenceWatch(double tolerance, double patience);

    /** @brief Iterations with multigrid above which a factorisation is preferred, of a system of
     * that size (doc/benchmarks.md). */
    static double
    patience(int n_dofs);

    /** @brief Whether the next residual matters. */
    bool
    wants_next() const;

    /** @brief The next residual, the first one before the first iteration.
     * @throws SlowConvergence */
    void
    next(double residual);

    /** @brief Count an iteration whose residual is not computed. */
    void
    skip()
    {
      ++n_residuals;
    }

    unsigned int
    iterations() const
    {
      return n_residuals > 0 ? n_residuals - 1 : 0;
    }

  private:
    const double tolerance, limit;
    unsigned int n_residuals = 0;
    double       first = 0., smallest = 0.;
  };

  /**
   * @brief Whether multigrid is given up for the rest of the run: after one failure in a symmetric
   * system, where the bodies are the cause, and after three successive failures in unsymmetric
   * ones, where the cause may be a single Newton iterate with large forces of friction.
   */
  class Strikes
  {
  public:
    void
    failed(const bool symmetric)
    {
      n += symmetric ? most : 1;
    }
    void
    succeeded()
    {
      n = 0;
    }
    bool
    out() const
    {
      return n >= most;
    }

  private:
    static constexpr unsigned int most = 3;
    unsigned int                  n    = 0;
  };
} // namespace Touchstone

#endif
