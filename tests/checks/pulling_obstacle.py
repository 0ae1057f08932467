# SPDX-License-Identifier: LGPL-2.1-or-later
"""An obstacle that comes in by more than half of its thickness within a step does not pull the surface
out on its other side, at points inside slave faces and at nodes: the step is cut, or the run ends."""

from touchstone_test import STEPS, below, check, finish, relative, run, tests

SCENE = tests / "obstacle_in_slave_face.prm"
for name, place in ("face", {}), ("node", {"Obstacle ball/Point": "0.2, 0.2, 0.105"}):
    five = run(name, SCENE, place)
    check(five.force("c")[2] < 0, f"{five}: the force pulls")
    one = run(f"{name}_one_step", SCENE, {**place, STEPS: 1})
    check(one.cuts() > 0, f"{one}: not cut")
    below(f"{one}, force", relative(one.force("c")[2], five.force("c")[2]), 1e-6)
ends = run("no_cuts", SCENE, {STEPS: 1, "Load stepping/Maximum cuts": 0}, fails=True)
ends.says("pulls at 'low'")
finish()
