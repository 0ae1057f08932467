#include <touchstone/algebra/non_convergence.h>
#include <touchstone/drive/newton.h>

#include <cmath>
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
    text << "no convergence in " << parameters.maximum_iterations
         << " Newton iterations: residual " << state.residual << ", gap " << state.gap << ", "
         << state.changes << " contact rows changed";
    throw NewtonFailure(text.str());
  }
} // namespace Touchstone
