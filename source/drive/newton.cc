// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/non_convergence.h>
#include <touchstone/drive/newton.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>
#include <vector>

// Semismooth Newton method with active set, line search and detection of cycles (doc/theory.md 5).
// It knows the problem only through NonlinearProblem, and reports failure by exceptions of the kind
// NonConvergence, on which the load stepping cuts the step.
namespace Touchstone
{
  namespace
  {
    /**
     * Nonmonotone line search on the norm of the out-of-balance force. At finite strain this norm
     * often rises for one iteration before it decreases quadratically, so an increment is rejected
     * only if it exceeds twice the larger of the last two values (doc/theory.md 5, "Line search").
     * Grippo, Lampariello and Lucidi (1986), SIAM J. Numer. Anal. 23.
     */
    class LineSearch
    {
    public:
      explicit LineSearch(const NewtonParameters &parameters)
        : parameters(parameters)
        , on(parameters.line_search == NewtonParameters::LineSearch::automatic)
      {
      }

      /** Record a state from which the next increment starts. Forces are comparable only as long
       * as the active set does not change and prescribed displacements are met. */
      void
      start_from(const NewtonState &state)
      {
        if (!state.prescribed || state.changes > 0 || state.signature != last.signature)
          forces.clear();
        if (state.prescribed && state.changes == 0)
          forces.push_back(state.force);
        last = state;
      }

      /** Whether the increment to @p state has increased the force too much. Never if the state
       * before was in equilibrium, since then its force is no measure; if gaps have decreased,
       * since closing them changes the forces; or near the tolerance, where round-off dominates. */
      bool
      failed(const NewtonState &state, const double factor = much_worse) const
      {
        const std::size_t n = monotone ? 1 : memory;
        if (!on || forces.size() < n || !state.prescribed || state.changes > 0 ||
            state.signature != last.signature || balanced(last, parameters) ||
            state.residual <= 100. * parameters.residual_tolerance ||
            (!monotone && last.gap > parameters.gap_tolerance && state.gap < last.gap))
          return false;
        // Negated, so that NaN has failed as well.
        const double highest = *std::max_element(forces.end() - n, forces.end());
        return !(state.force <= (monotone ? 1. : factor) * highest);
      }

      /** Whether increments oscillate: the force has not decreased for twice some iterations
       * with one active set, as of a plastic body whose increments pass the yield surface each
       * time. From then on each increment must decrease it. */
      bool
      oscillates(const NewtonState &state)
      {
        if (!on || monotone || forces.size() < std::size_t(2 * turns) || !state.prescribed ||
            state.changes > 0 || state.signature != last.signature ||
            state.residual <= 100. * parameters.residual_tolerance)
          return false;
        const auto middle = forces.end() - turns;
        monotone          = *std::min_element(middle, forces.end()) >
                   no_gain * *std::min_element(middle - turns, middle);
        return monotone;
      }

      /** Halve the increment until the force is not above the highest before; all of it, for the
       * rest of the step, if no part is: then its direction is wrong and not its length. */
      NewtonState
      shorten(NonlinearProblem &problem, const unsigned int damping)
      {
        NewtonState state;
        for (double fraction : {0.5, 0.25, 0.125, 0.0625})
          {
            problem.shorten(fraction);
            state          = problem.residual(damping);
            state.fraction = fraction;
            if (!failed(state, 1.))
              return state;
          }
        on = false;
        problem.shorten(1.);
        return problem.residual(damping);
      }

    private:
      const NewtonParameters &parameters;
      bool                    on, monotone = false;
      /** Forces that count, and the factor by which they may rise. */
      static constexpr std::size_t memory     = 2;
      static constexpr double      much_worse = 2.;
      /** Iterations and the factor that are no progress. */
      static constexpr std::ptrdiff_t turns   = 4;
      static constexpr double         no_gain = 0.95;
      NewtonState                     last;
      std::vector<double>             forces;
    };
  } // namespace



  std::string
  exchanges_in_words(const NewtonState &state)
  {
    return state.exchanges == 0
             ? ""
             : ", " + std::to_string(state.exchanges) +
                 " went from a face, edge or vertex of the master to another one, or to none";
  }



  unsigned int
  Newton::solve(NonlinearProblem &problem, const Observer &observer, const unsigned int least) const
  {
    std::set<std::uint64_t> seen;
    unsigned int            damping = 0;
    int                     linear  = 0;
    NewtonState             state;
    double                  best  = std::numeric_limits<double>::max();
    unsigned int            stuck = 0, n_iterations = 0, settled = 0;
    LineSearch              line_search(parameters);
    // A front between stick and slip that moves over nodes on the cone, as under a belt, advances
    // by one node in each iteration: iterations in which the active set changes are not counted,
    // but all together are no more than twice as many (doc/theory.md 5, "Convergence").
    const unsigned int longest = 2 * parameters.maximum_iterations;
    for (unsigned int iteration = 0; iteration <= longest; ++iteration)
      {
        // Where round-off keeps forces from balance rows would not be judged at higher levels, see
        // Enforcement::update_active_set().
        constexpr unsigned int judges = 2;
        state        = problem.residual(stuck >= 3 ? std::min(damping, judges) : damping);
        n_iterations = iteration;
        if (iteration > 0 && (line_search.failed(state) || line_search.oscillates(state)))
          state = line_search.shorten(problem, damping);
        if (iteration > 0)
          observer(iteration, state, linear);
        // NaN compares as false and would pass for convergence or iterate to the limit.
        if (!std::isfinite(state.residual) || !std::isfinite(state.gap))
          throw NewtonFailure("the residual is not finite");
        if (iteration >= least && state.changes == 0 && state.prescribed &&
            balanced(state, parameters) && state.gap <= parameters.gap_tolerance)
          return iteration;
        // Round-off can keep the residual a little above the tolerance (large penalties, slivers
        // of overlap): a residual within 100 times its tolerance is accepted if everything else is
        // met and three iterations in turn have not halved the best value.
        const bool all_else = iteration > 0 && state.changes == 0 && state.prescribed &&
                              state.gap <= parameters.gap_tolerance;
        stuck = (all_else && state.residual > 0.5 * best) ? stuck + 1 : 0;
        best  = all_else ? std::min(best, state.residual) : std::numeric_limits<double>::max();
        if (stuck >= 3 && state.judged && state.residual <= 100. * parameters.residual_tolerance)
          return iteration;
        settled += (state.changes == 0);
        if (iteration == longest || settled > parameters.maximum_iterations)
          break;

        // An active set that recurs would recur for ever. Each recurrence raises the damping level:
        // then only the rows with the largest violation change, or only one row, see
        // Enforcement::update_active_set() and doc/theory.md 5, "Cycles".
        if (state.changes > 0 && !seen.insert(state.signature).second &&
            ++damping > 2 + parameters.maximum_iterations / 4)
          throw ActiveSetCycle("the active set cycles: " + std::to_string(state.changes) +
                               " rows keep changing their state" + exchanges_in_words(state));
        line_search.start_from(state);
        problem.linearize();
        linear = problem.solve();
        problem.update();
      }
    std::ostringstream text;
    text << "no convergence in " << n_iterations << " Newton iterations: residual "
         << state.residual << ", gap " << state.gap << ", " << state.changes
         << " contact rows changed" << exchanges_in_words(state)
         << (state.prescribed ? "" : ", prescribed displacements not met");
    throw NewtonFailure(text.str());
  }
} // namespace Touchstone
