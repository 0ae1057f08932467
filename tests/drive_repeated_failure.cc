// SPDX-License-Identifier: LGPL-2.1-or-later
// Whether a step fails with half its size as it did before.

#include <touchstone/drive/repeated_failure.h>

#include <iostream>
#include <limits>

using namespace Touchstone;

int
main()
{
  const NewtonParameters parameters;
  RepeatedFailure        failures(parameters);
  const auto             add = [&](const char           *what,
                       const NonConvergence &failure,
                       const double          residual,
                       const unsigned int    changes,
                       const char           *place) {
    NewtonState state;
    state.residual   = residual;
    state.changes    = changes;
    state.prescribed = true;
    std::cout << what << ": " << (failures.add(failure, state, place) ? "the same" : "another")
              << std::endl;
  };
  const NewtonFailure newton("no convergence");
  add("first", newton, 1e-3, 0, "a");
  add("same state and place", newton, 1.001e-3, 0, "a");
  add("half the residual", newton, 0.5e-3, 0, "a");
  add("another place", newton, 0.5e-3, 0, "b");
  add("other changes", newton, 0.5e-3, 7, "b");
  add("another reason", ActiveSetCycle("a cycle"), 0.5e-3, 7, "b");
  add("the same cycle", ActiveSetCycle("a cycle"), 0.5e-3, 7, "b");
  failures.forget();
  add("after a step that converged", ActiveSetCycle("a cycle"), 0.5e-3, 7, "b");
  add("round-off", newton, 2e-12, 4, "c");
  add("other round-off", newton, 3e-12, 4, "c");
  const double none = std::numeric_limits<double>::quiet_NaN();
  add("before any iteration", InvertedCells("inverted"), none, 0, "");
  add("again", InvertedCells("inverted"), none, 0, "");
  // Shorter steps gain less, if only from some size on.
  add("energy", EnergyGain("a gain"), 1e-12, 0, "d");
  add("energy again", EnergyGain("a gain"), 1e-12, 0, "d");
  // Where nodes are in balance nothing of the state tells attempts apart.
  add("a tool", NotBalanced("a tool", 0.1), 1e-14, 0, "e");
  add("another part is missing", NotBalanced("a tool", 0.03), 2e-14, 0, "e");
  add("the same part is missing", NotBalanced("a tool", 0.0301), 1e-14, 0, "e");
  add("thrown off", LostContact("a body"), 1e-14, 0, "f");
  add("thrown off again", LostContact("a body"), 1e-14, 0, "f");
  return 0;
}
