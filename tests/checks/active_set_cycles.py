# SPDX-License-Identifier: LGPL-2.1-or-later
"""Active sets that went in circles: a point inside a slave face between stick and slip, when its step was
solved from a state without it, and rows of a body that yields, judged before their set was solved. One
answer of all enforcements and on two ranks."""

from touchstone_test import AUGMENTED, MULTIPLIERS, below, check, checks, finish, relative, run, tests

YIELDS = {"Body block/Material/Law": "small-strain von Mises",
          **{f"Body block/Material/Plasticity/{key}": value for key, value in (
              ("Hardening", "linear"), ("Yield stress", 5), ("Hardening modulus", 100))}}
ALL = {"multipliers": (MULTIPLIERS, 1, 1e-6), "augmented": (AUGMENTED, 1, 1e-5), "ranks": ({}, 2, 1e-6)}
# The support of the last jumps to the other side at t = 0, 1.5 and 2.5: no step is short enough for it.
for name, scene, settings, cuts, others in (
        ("trough", checks / "ball_in_trough.prm", {}, 0, ["multipliers"]),
        ("tube", checks / "tube_in_wide_faces.prm", {}, 1, ["ranks"]),
        ("rocking", tests / "hard_rocking.prm", YIELDS, 0, ALL)):
    one = run(name, scene, settings)
    most = max(one.column("cuts"))
    check(most <= cuts, f"{one}: a step of the input is halved {most} times")
    for other in others:
        more, ranks, bound = ALL[other]
        result = run(f"{name}_{other}", scene, {**settings, **more}, ranks=ranks)
        for axis in 0, 2:
            below(f"{result}, force {axis}",
                  relative(result.force("contact")[axis], one.force("contact")[axis]), bound)
finish()
