# SPDX-License-Identifier: LGPL-2.1-or-later
"""What must be the same is the same: one rank and two, elimination and multipliers (1e-8), MUMPS
and Belos CG or GMRES (1e-6), one load step and ten, and the same scene in other units. The one
check that crosses enforcements with solvers and ranks."""
# ctest: goldens = press_fit, tied_non_matching, tied_non_matching.mpirun=2, units_mm, units_si

from touchstone_test import (CG, GAP, GMRES, MULTIPLIERS, RESIDUAL, STEPS, finish, golden, prm, run,
                             same, tests)

SHARP = {RESIDUAL: 1e-10}
# A gap of 1e-8 faces, the default tolerance, makes 2e-7 of the force.
CLOSED = {**SHARP, GAP: 1e-11}


def compare(name, scene, settings=None, one=None, two=None):
    """All that has the same result. Runs that are there already may be given."""
    settings = settings or {}
    one = one or run(name, scene, settings)
    same(one, two or run(f"{name}-2", scene, settings, 2), 1e-8, newton=True)
    same(one, run(f"{name}-multipliers", scene, {**settings, **MULTIPLIERS}), 1e-8)
    same(one, run(f"{name}-belos", scene, {**settings, **CG}), 1e-6)
    same(one, run(f"{name}-belos-2", scene, {**settings, **CG}, 2), 1e-6)
    return one


compare("press_fit", tests / "press_fit.prm", one=golden("press_fit"))
non_matching = compare("non_matching", tests / "press_fit_fine_slave.prm", SHARP)
tubes = compare("two_tubes", prm / "two_tubes.prm", {STEPS: 1, **CLOSED})
compare("hertz", tests / "hertz_sphere.prm", SHARP)
tied = compare("tied", tests / "tied_non_matching.prm", one=golden("tied_non_matching"),
               two=golden("tied_non_matching", 2))
compare("sphere", tests / "sphere_obstacle.prm", SHARP)

same(non_matching, run("non_matching-gmres", tests / "press_fit_fine_slave.prm",
                       {**SHARP, **GMRES}), 1e-6)
same(tied, run("tied-gmres-2", tests / "tied_non_matching.prm", GMRES, 2), 1e-6)

# Without friction the history of the load does not count.
same(run("one_step", tests / "sphere_obstacle.prm", {**SHARP, STEPS: 1}),
     run("ten_steps", tests / "sphere_obstacle.prm", {**SHARP, STEPS: 10}), 1e-8)
same(tubes, run("tubes_ten_steps", prm / "two_tubes.prm", {**CLOSED, STEPS: 10}), 1e-7)

# N, mm, MPa and N, m, Pa: the same iterations.
same(golden("units_mm"), golden("units_si"), 1e-8, newton=True, moment=1e-3, area=1e-6,
     max_pressure=1e6)
finish()
