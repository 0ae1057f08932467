# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies with large strain on one rank and two, with both solvers and all enforcements; F-bar
against degree 2 and the element that locks; cells that turn inside out."""
# ctest: goldens = large_bending

import re
import shutil

from touchstone_test import (AUGMENTED, CG, DEGREE, FACTOR, MULTIPLIERS, RESIDUAL, STEPS, Run, below,
                             check, checks, finish, folder, golden, launch, run, same,
                             settings_options, tests)

SHARP = {RESIDUAL: 1e-11}


def squeezed(name, settings=None, ranks=1):
    return run(name, tests / "squeezed_ball.prm", {**SHARP, **(settings or {})}, ranks)


# How the solution is found does not count.
ball = squeezed("ball")
same(ball, squeezed("ball-2", ranks=2), 1e-8, newton=True)
same(ball, squeezed("multipliers", MULTIPLIERS, 2), 1e-8)
same(ball, squeezed("augmented", AUGMENTED), 1e-6)
same(ball, squeezed("belos", CG, 2), 1e-7)
same(ball, squeezed("ten", {STEPS: 10}), 1e-8)
same(squeezed("degree_2", {DEGREE: 2}), squeezed("degree_2-2", {DEGREE: 2}, 2), 1e-8, newton=True)


# F-bar is right within 1 % and as good as the fine mesh, of degree 2, on a finer one; the element
# without it does not move.
def bend(name, settings=None, ranks=1):
    return run(name, tests / "large_bending.prm", settings, ranks)


below("bending, tip", golden("large_bending").error("point_displacement"), 1e-2)
below("bending_fine, tip", bend("fine", {FACTOR: 2}, 2).error("point_displacement"), 1e-3)
locked = bend("locked", {"Body strip/Element": "full"}).error("point_displacement")
check(locked > 0.9, f"full integration does not lock: error {locked}")

# One step is too large and is cut, and the history does not count.
cut = bend("cut", {STEPS: 1, **SHARP})
check(cut.cuts() > 0, "bent in one step without a cut")
same(bend("sharp", SHARP), cut, 1e-7)

# Nothing can be squeezed through itself: the step is cut, and the run ends with the
# reason and the last converged state. Pulled as far it converges.
for ranks in 1, 2:
    shutil.rmtree(folder / "results", ignore_errors=True)
    done = launch("--output", "results", *settings_options({"Load stepping/Maximum cuts": 2}),
                  checks / "finite_strain.prm", ranks=ranks)
    check(done.returncode == 2, f"exit code {done.returncode} instead of 2")
    check(re.search(r"^Not converged: a cell turns inside out \(det F <= 0\).* increment: "
                    r"body 'block' at \(.*cut 2 times\)",
                    done.stdout, re.M), f"the reason is missing: {done.stdout}")
    Run("squeezed through itself", "results", "").says("trying again with a step of 0.5")
    check('timestep="0.75"' in (folder / "results/solution.pvd").read_text(encoding="utf-8"),
          "no VTU file of the last converged state")
run("pulled", checks / "finite_strain.prm", {"Body block/Boundary top/Displacement z": "1.2*t"})
finish()
