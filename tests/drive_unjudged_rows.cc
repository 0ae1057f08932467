// SPDX-License-Identifier: LGPL-2.1-or-later
// Where sets of contact rows recur, rows are judged only once forces are in balance. A residual
// that stagnates a little above its tolerance is accepted, but not before the rows have been
// judged: here one of them is wrong, which only such a judgement tells.

#include <touchstone/drive/newton.h>

#include <iostream>

using namespace Touchstone;

namespace
{
  struct Stagnating : public NonlinearProblem
  {
    /** Whether the sets have recurred so often that they are no longer judged at once. */
    bool stagnates = false;
    bool wrong     = true;

    NewtonState
    residual(const unsigned int damping) override
    {
      stagnates = stagnates || damping > 2;
      NewtonState state;
      state.prescribed = true;
      state.force = state.residual = stagnates ? 5e-10 : 1.;
      state.signature              = 1;
      state.judged                 = !stagnates || damping <= 2;
      state.changes                = !stagnates || (state.judged && wrong);
      if (stagnates && state.judged)
        wrong = false;
      return state;
    }
    void
    linearize() override
    {
    }
    int
    solve() override
    {
      return -1;
    }
    void
    update() override
    {
    }
    void
    shorten(double) override
    {
    }
  };
} // namespace



int
main()
{
  NewtonParameters parameters;
  parameters.residual_tolerance = 1e-10;
  parameters.line_search        = "none";
  Stagnating         problem;
  const unsigned int iterations =
    Newton(parameters).solve(problem, [](unsigned int, const NewtonState &, int) {});
  std::cout << iterations << " iterations, a row that is wrong is "
            << (problem.wrong ? "accepted" : "found") << std::endl;
  return 0;
}
