# SPDX-License-Identifier: LGPL-2.1-or-later
"""Active sets that cycled: a point inside a slave face between stick and slip, when its step was
solved from a state without it, and rows of a body that yields, judged before their set was solved; and nodes
that went to and fro between two faces of a valley. Nodes that an iterate has closed beyond the end of the
master. A node in the dent that it has made in a smooth surface of degree 2, the sides of which were a sharp edge
in every other iterate, and on the edge between two faces there. Averaged rows beside the edge of the contact between
faces of unequal size, where the gap of a row fell as its node rose and its neighbours sank. A node on
the edge between two faces that lie over each other. One answer of all enforcements and solvers, and on two ranks."""

from touchstone_test import AUGMENTED, CG, GMRES, MULTIPLIERS, below, check, checks, finish, run, tests

YIELDS = {"Body block/Material/Law": "small-strain von Mises",
          **{f"Body block/Material/Plasticity/{key}": value for key, value in (
              ("Hardening", "linear"), ("Yield stress", 5), ("Hardening modulus", 100))}}
# Three nodes and then one in a dent of a cap, in which a node comes to rest on the edge between two faces.
DENT = {"Body top/Boundary far/Displacement x": "0.1 * max(0, t - 1)",
        "Body top/Boundary far/Displacement z": "-0.05 * min(1, t)", "Load stepping/Steps": 3}
# A wider cap on other faces, where the first step failed.
WIDER = {"Body top/Geometry/Radius": 2.5, "Body low/Geometry/Cells": "4, 3, 2",
         "Body low/Geometry/Grading": "1.29, 0.69, 0.7", "Body top/Geometry/Contact cells": 4,
         "Body top/Geometry/Contact width": 0.226}
ALL = {"multipliers": (MULTIPLIERS, 1, 1e-6), "augmented": (AUGMENTED, 1, 1e-5), "ranks": ({}, 2, 1e-6),
       "gmres": (GMRES, 1, 1e-6), "cg": (CG, 1, 1e-6)}
# The support of the last jumps to the other side at t = 0, 1.5 and 2.5: no step is short enough for it.
for name, scene, settings, cuts, others in (
        ("trough", checks / "ball_in_trough.prm", {}, 0, ["multipliers"]),
        ("tube", checks / "tube_in_wide_faces.prm", {}, 1, ["ranks"]),
        ("end", checks / "beyond_the_end.prm", {}, 0, ["gmres"]),
        ("valley", checks / "node_in_valley.prm", {}, 0, ["multipliers", "augmented", "ranks", "gmres"]),
        ("apex", tests / "dent_in_cap.prm", {}, 0, ["multipliers", "augmented", "ranks"]),
        ("dent", tests / "dent_in_cap.prm", DENT, 0, ["multipliers", "ranks"]),
        ("cap", checks / "quarter_cap.prm", {}, 0, ["multipliers", "ranks"]),
        ("cap_wider", checks / "quarter_cap.prm", WIDER, 0, ["multipliers"]),
        ("between", checks / "node_between_faces.prm", {}, 0, ["gmres", "cg"]),
        ("rocking", tests / "hard_rocking.prm", YIELDS, 0, ["multipliers", "augmented", "ranks"])):
    one = run(name, scene, settings)
    most = max(one.column("cuts"))
    check(most <= cuts, f"{one}: a step of the input is halved {most} times")
    for other in others:
        more, ranks, bound = ALL[other]
        result = run(f"{name}_{other}", scene, {**settings, **more}, ranks=ranks)
        force, other_force = one.force("contact"), result.force("contact")
        below(f"{result}, force", max(abs(a - b) for a, b in zip(force, other_force)) /
              max(map(abs, force)), bound)
finish()
