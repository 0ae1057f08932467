# SPDX-License-Identifier: LGPL-2.1-or-later
"""The rope in one step. With line search no step is cut, the iterations are no more than 15, or 25
with the springs of a penalty, and fewer than without it; the result is that of small steps.
Without it Newton's method goes a wild way that depends on round-off, 24 to 55 iterations: a step
is cut with one of the enforcements at least, and with a penalty it may find another
equilibrium."""

from touchstone_test import ENFORCEMENT, STEPS, below, check, finish, run, same, tests

NONE = {"Newton/Line search": "none"}
cut = 0
for enforcement in "elimination", "lagrange multipliers", "penalty":
    settings = {ENFORCEMENT: enforcement}
    searched = run(enforcement, tests / "rope.prm", settings)
    small = run(f"small_{enforcement}", tests / "rope.prm", {**settings, **NONE, STEPS: 8})
    full = run(f"full_{enforcement}", tests / "rope.prm", {**settings, **NONE})
    same(searched, small, 1e-6)
    check("trying again" not in searched.log, f"{enforcement}: a step was cut")
    cut += "trying again" in full.log
    below(f"{enforcement}, iterations with line search", searched.iterations(),
          min(26 if enforcement == "penalty" else 16, full.iterations()))
check(cut > 0, "no step was cut without line search")
finish()
