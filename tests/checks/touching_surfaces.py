# SPDX-License-Identifier: LGPL-2.1-or-later
"""Surfaces that touch or nearly touch have no overlap, wherever nodes, edges and the closest points
lie: balls of few faces on plates, also where these end, and a plate under a rounded edge, in both
roles, at random positions and mesh ratios; no force between them."""

import random
import re

from touchstone_test import below, check, checks, finish, launch, run, settings_options

BALL, EDGE = checks / "ball_between_plates.prm", checks / "under_rounded_edge.prm"
PLATES = {"a": ("low", "top"), "b": ("high", "bottom")}


def plates_are_slaves():
    result = {}
    for pair, (plate, side) in PLATES.items():
        for role, body, boundary in ("Slave", plate, side), ("Master", "ball", "surface"):
            result[f"Contact pair {pair}/{role} body"] = body
            result[f"Contact pair {pair}/{role} boundaries"] = boundary
    return result


def ball(centre, cells, of_ball, exchanged, turned, top=2):
    """Settings of the ball between plates; turned about their corners these end near its pole."""
    result = plates_are_slaves() if exchanged else {}
    result["Body ball/Geometry/Centre"] = f"{centre[0]}, {centre[1]}, 1"
    result["Body ball/Geometry/Cells"] = of_ball
    for plate in "low", "high":
        result[f"Body {plate}/Geometry/Cells"] = f"{cells}, {cells}, 1"
        result[f"Body {plate}/Geometry/Rotation"] = f"0, 0, {turned}"
    result["Body high/Geometry/Lower corner"] = f"-1.5, -1.5, {top}"
    return result


def first_gaps(name, scene, settings, ranks=1, bound=1e-9):
    """No pair overlaps before anything has moved."""
    done = launch("--validate", *settings_options(settings), scene, ranks=ranks)
    gaps = [float(gap) for gap in re.findall(r"smallest gap ([-+.\de]*\d)", done.stdout)]
    check(done.returncode == 0 and gaps, f"{name}: {done.stdout}")
    below(f"{name} {settings}: overlap", max(0, -min(gaps, default=-1)), bound)


# Inside coarse slave faces rows of covered nodes still are up to 3e-3 off.
rng = random.Random(3)
for i in range(12):
    side = rng.choice((3, 4, 5, 6, 9))
    place = [round(rng.uniform(0, 3 / side), 3) for _ in range(2)]
    first_gaps(f"ball {i}", BALL, ball(place, side, f"{rng.randint(1, 3)}, 1", i % 2,
                                       45 if i % 3 == 0 else 0), ranks=1 + (i == 5), bound=3e-3)
# With shape functions of degree 2, which are negative on parts of a face, a ball overlapped by 1.7e-5 where
# it touched with a corner of its faces, and bodies pressed each other.
others = random.Random(4)
for i in range(6):
    side = others.choice((3, 4, 5))
    place = [round(others.uniform(0, 3 / side), 3) if i > 1 else 0 for _ in range(2)]
    cells = f"{others.randint(1, 3)}, 1"
    first_gaps(f"ball {i}, degree 2", BALL, {**ball(place, side, cells, i % 2, 0), "Discretisation/Degree": 2})
# Over a face that the edge leaves half-way, rows of covered nodes still are up to 2e-3 of its size off.
for i in range(8):
    corner = [round(rng.uniform(low, high), 3) for low, high in ((-1.3, -0.9), (-0.6, 0.6))]
    first_gaps(f"edge {i}", EDGE, {
        "Body top/Geometry/Corner": f"{corner[0]}, {corner[1]}, 0",
        "Body top/Geometry/Cells": f"{rng.randint(1, 5)}, {rng.randint(1, 3)}",
        "Body low/Geometry/Cells": f"{rng.randint(2, 6)}, {rng.randint(2, 6)}, 1"}, bound=2e-3)

# Beside the ends of the plates no convergence before.
for name, settings in (("at_end", ball((0.0403, 0.1109), 9, "3, 1", False, 45)),
                       ("at_end_exchanged", ball((0.0403, 0.1109), 9, "3, 1", True, 45))):
    result = run(name, BALL, settings)
    for pair in "ab":
        below(f"{name}, force of {pair}", max(map(abs, result.force(pair))), 1e-9)

# A cylinder that fits into a tube and moves along it: round-off makes forces of gaps, and of no force no balance
# can be asked. Which nodes are active is round-off, too.
for ranks in 1, 2:
    fit = run(f"pushed_along_{ranks}", checks / "pushed_along.prm", ranks=ranks)
    below(f"{fit}, force by stiffness", max(map(abs, fit.force("fit"))) / (1e-4 * 1000**2), 1e-12)
    check(fit.value("steps") == 4, f"{fit}: steps are cut")
finish()
