# SPDX-License-Identifier: LGPL-2.1-or-later
"""Averaged rows where slave faces are covered in part: pressures bounded wherever the edge of the
master surface lies, forces and moments exact and smooth as it moves, none between bodies that only touch."""

import math

from touchstone_test import STEPS, below, check, checks, finish, relative, run, same

# Pressed with 10; with the basis dual on the covered part alone 16, 50, 344 for 1.2, 1.05, 1.01.
for width in 1.0001, 1.01, 1.05, 1.18, 1.25, 1.32, 1.4999:
    edge = run(f"edge_{width}", checks / "pressed_over_edge.prm",
               {"Body pad/Geometry/Upper corner": f"{width},{width},0"})
    below(f"{edge}, max_pressure", edge.contact("c", "max_pressure"), 22)
    below(f"{edge}, force off by", relative(edge.force("c")[2], 10 * width ** 2), 1e-9)

# The whole pad, held by friction alone, under a pressure that is not uniform: what carries it has the force and the
# moments of the pressure wherever the four edges of the pad lie. Moments are of the deformed state, hence stiff bodies.
stiff = {"Body plate/Material/Young modulus": 1e9, "Body pad/Material/Young modulus": 1e9}
width, y = 1.05, 0.27
for x in 0.2, 0.31, 0.4, 0.4499, 0.4501, 0.4999, 0.5001, 0.62, 0.75:
    pad = run(f"pad_{x}", checks / "pressed_over_edge.prm", {
        **stiff, "Body plate/Symmetry": "", "Body plate/Fixed": "top", "Body pad/Symmetry": "",
        "Body pad/Geometry/Lower corner": f"{x}, {y}, -1",
        "Body pad/Geometry/Upper corner": f"{x + width}, {y + width}, 0",
        "Body pad/Boundary bottom/Pressure":
            f"10 * (1 + 0.4 * (x - {x + width / 2}) / {width} + 0.2 * (y - {y + width / 2}) / {width})",
        "Contact pair c/Behaviour": "coulomb", "Contact pair c/Friction/Coefficient": 0.3})
    load = 10 * width ** 2
    moment = [m / load for m in pad.vector("results", "contact", "c", "moment")]
    below(f"{pad}, max_pressure", pad.contact("c", "max_pressure"), 22)
    below(f"{pad}, force off by", relative(pad.force("c")[2], load), 1e-9)
    for axis, arm, exact in (("x", moment[0], y + width / 2 + 0.2 * width / 12),
                             ("y", moment[1], -x - width / 2 - 0.4 * width / 12), ("z", moment[2], 0)):
        below(f"{pad}, moment about {axis} off by, over force and width", abs(arm - exact) / width, 2e-9)

# A washer on a plate whose hole lies beside its own, cut by a plane of symmetry: the resultant passes through the centre of
# the washer. Pressed with 40; the pressure was 7305 where faces are covered in slivers.
stiff = {"Body plate/Material/Young modulus": 2.1e9, "Body washer/Material/Young modulus": 2.1e9}
for offset in 0.05, 0.35, 0.7, 0.95:
    washer = run(f"washer_{offset}", checks / "friction_beside_symmetry.prm",
                 {**stiff, "Body plate/Geometry/Origin": f"{offset}, 0, 0"})
    # Of 20 facets.
    load = 40 * 10 * math.sin(math.pi / 20) * (8 ** 2 - 4 ** 2)
    below(f"{washer}, max_pressure", washer.contact("c", "max_pressure"), 150)
    below(f"{washer}, force off by", relative(washer.force("c")[2], -load), 1e-9)
    below(f"{washer}, moment about y over force and radius",
          abs(washer.vector("results", "contact", "c", "moment")[1]) / load / 8, 5e-9)

# Touching, and 0.01 apart above; coarse balls too.
for cells in "3, 4", "2, 2", "2, 5":
    for top in 2, 2.01:
        ball = run(f"ball_{cells}_{top}", checks / "ball_between_plates.prm",
                   {"Body ball/Geometry/Cells": cells,
                    "Body high/Geometry/Lower corner": f"-1.5,-1.5,{top}"})
        for pair in "ab":
            below(f"{ball}, force of {pair}", abs(ball.force(pair)[2]), 1e-12)

# The force changes by a tenth when the mesh does.
for cells in 12, 13, 20:
    punch = run(f"punch_{cells}", checks / "slave_larger_than_master.prm",
                {"Body low/Geometry/Cells": f"{cells}, {cells}, 2"})
    below(f"{punch}, differs from a fine mesh", relative(punch.force("c")[2], -36), 0.1)

# Both edges of the base go over more than a face of the block, in positions half a percent of a
# face apart: rows come and go, and the force changes by less than half a percent each time.
slide = run("slide", checks / "sliding_edge.prm", {STEPS: 480})
column = list(slide.rows()[0])[8]
force = [row[column] for row in slide.rows() if row["time"] >= 1]
below(f"slide, largest change of '{column}'",
      max(relative(b, a) for a, b in zip(force, force[1:])), 5e-3)
# So does the place of the resultant, over the length of the base.
arm = [-row["contact: moment y"] / row["contact: force z"] for row in slide.rows() if row["time"] >= 1]
below("slide, largest step of the resultant", max(abs(b - a) for a, b in zip(arm, arm[1:])), 5e-3)
# A finger that is driven sideways against a post which its tip overlaps in height by a part of a face. Conditions of
# neighbouring nodes refer to each other there: eliminated one by one, as without friction they were, gaps fell by 15 %
# in an iteration, or not at all on a finer finger, and the run ended with "there may be no static equilibrium".
for cells in "3, 4, 9", "3, 8, 9":
    fingers = [run(f"finger_{name}_{cells[3]}", checks / "finger.prm",
                   {**settings, "Body finger/Geometry/Cells": cells}, ranks=ranks)
               for name, settings, ranks in (("elimination", {}, 1), ("2_ranks", {}, 2),
                                             ("multipliers", {"Contact/Enforcement": "lagrange multipliers"}, 1))]
    for result in fingers:
        same(fingers[-1], result, 1e-6)
        check(result.iterations() <= 40, f"{result}: {result.iterations()} iterations")
finish()
