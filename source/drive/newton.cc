#include <touchstone/algebra/non_convergence.h>
#include <touchstone/drive/newton.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

namespace Touchstone
{
  unsigned int
  Newton::solve(NonlinearProblem &problem, const Observer &observer) const
  {
    std::set<std::uint64_t> seen;
    unsigned int            caution = 0;
    int                     linear  = 0;
    NewtonState             state;
    double                  best  = std::numeric_limits<double>::max();
    unsigned int            stuck = 0;
    for (unsigned int iteration = 0; iteration <= parameters.maximum_iterations; ++iteration)
      {
        state = problem.residual(caution);
        if (iteration > 0)
          observer(iteration, state, linear);
        if (!std::isfinite(state.residual) || !std::isfinite(state.gap))
          throw NewtonFailure("the residual is not finite");
        if (state.changes == 0 && state.prescribed && balanced(state, parameters) &&
            state.gap <= parameters.gap_tolerance)
          return iteration;
        // Round-off can hold the residual a little above the tolerance (large
        // penalties, slivers of overlap): if all else is met and three iterations
        // gain nothing, more of them will not.
        const bool all_else = iteration > 0 && state.changes == 0 && state.prescribed &&
                              state.gap <= parameters.gap_tolerance;
        stuck = (all_else && state.residual > 0.5 * best) ? stuck + 1 : 0;
        best  = all_else ? std::min(best, state.residual) : std::numeric_limits<double>::max();
        if (stuck >= 3 && state.residual <= 100. * parameters.residual_tolerance)
          return iteration;
        if (iteration == parameters.maximum_iterations)
          break;

        // A set that was left and comes back would come back for ever. Changing
        // only the rows that ask most strongly leads elsewhere.
        if (state.changes > 0 && !seen.insert(state.signature).second &&
            ++caution > 2 + parameters.maximum_iterations / 4)
          throw ActiveSetCycle("the active set goes in circles: " + std::to_string(state.changes) +
                               " rows keep changing their state");
        problem.linearize();
        linear = problem.solve();
        problem.update();
      }
    std::ostringstream text;
    text << "no convergence in " << parameters.maximum_iterations << " Newton iterations: residual "
         << state.residual << ", gap " << state.gap << ", " << state.changes
         << " contact rows changed"
         << (state.prescribed ? "" : ", prescribed displacements not met");
    throw NewtonFailure(text.str());
  }
} // namespace Touchstone
