# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rigid motions, impacts and friction over 100,000 cycles of explicit dynamics: momentum, its moment,
energy, and a block on a slope that stays or slides (doc/explicit.md, section 9.7)."""

import math
import os

from touchstone_test import STEPS, below, check, checks, contact_gives, finish, run


def drift(result, start, quantity):
    """Largest difference of a vector of the statistics from that of a run that ends before any
    impact, relative to its size."""
    first, *values = [[row[f"{quantity} {axis}"] for axis in "xyz"]
                      for row in (*start.rows(), *result.rows())]
    return max(math.dist(value, first) for value in values) / math.hypot(*first)


def keeps_momentum(result):
    """Momentum to 1e-13 and its moment to 1e-12, in all of 100,000 cycles."""
    start = run(f"{result}_start", checks / f"explicit_{result}.prm",
                {"Load stepping/End time": 0.01, STEPS: 1})
    check(start.rows()[0].get("pair: active nodes", 0) == 0, f"{start}: contact from the start")
    check(result.value("cycles") > 1e5, f"{result}: only {result.value('cycles')} cycles")
    below(f"{result}, change of momentum", drift(result, start, "momentum"), 1e-13)
    below(f"{result}, change of the moment of momentum",
          drift(result, start, "angular momentum"), 1e-12)


# A free block. Its energy of velocities half a cycle off varies by terms of the order h^2 only.
spinning = run("spinning", checks / "explicit_spinning.prm")
keeps_momentum(spinning)
energy = [row["energy: kinetic"] + row["energy: strain"] + row["energy: hourglass"]
          for row in spinning.rows()]
below("spinning, variation of energy", max(energy) / min(energy) - 1, 1e-5)
below("spinning, drift of energy",
      abs(sum(energy[-10:]) - sum(energy[:10])) / sum(energy[:10]), 1e-6)

# Two blocks that collide. With CONFINED=1 in the environment (by hand, two minutes) also a block that hits
# the wall of a tube around it again and again.
SCENES = [("collision", 1)] + ([("confined", 10)] if os.environ.get("CONFINED") else [])
for name, impacts in SCENES:
    two = run(name, checks / f"explicit_{name}.prm")
    keeps_momentum(two)
    check(two.value("motion", "impacts", "pair", "openings") >= impacts, f"{two}: no impacts")
    energies = two.summary["motion"]["energies"]
    check(name != "collision" or
          any("far from normal to the slave surface" in text for text in two.summary["warnings"]),
          f"{two}: no warning of a corner that hits a face between its nodes")
    check(energies["friction"] > 0.01 * energies["initial"], f"{two}: no friction")
    contact_gives(two, 1e-6)

# A block on a slope is at rest after a twentieth of the run. Then it moves no more: friction has no
# work, and nodes are where they were.
still = run("slope", checks / "explicit_slope.prm", vtu=10)
check(still.value("cycles") > 1e5, f"slope: only {still.value('cycles')} cycles")
below("slope, force along", abs(still.force("contact")[0] + 0.2 * 2), 1e-10)
below("slope, force across", abs(still.force("contact")[2] - 2), 1e-10)
work = still.column("energy: friction")
check(work[-1] > 0, "slope: friction had no work at all")
below("slope, slip in 95,000 cycles", abs(work[-1] - work[0]) / (0.3 * 2), 1e-10)
nodes = still.contact_nodes(10), still.contact_nodes(20)
below("slope, creep", max(math.dist(a.deformed(), b.deformed()) for a, b in zip(*nodes)), 1e-10)
check(len(nodes[0]) == 15 and max(math.hypot(*node.displacement) for node in nodes[0]) > 1e-8,
      "slope: nodes have not moved at all")

# It slides if friction is small: the momentum is exact, as the force of friction is 0.1 of that of
# contact; velocities are those of half a cycle before the end.
slides = run("slides", checks / "explicit_slope.prm",
             {"Contact pair contact/Friction/Coefficient": 0.1,
              "Body block/Material/Rayleigh mass": 0, "Load stepping/End time": 8, STEPS: 8})
for row in slides.rows():
    falls = row["time"] - row["shortest cycle"] / 2 - 0.5
    below(f"slides, momentum at {row['time']:g}",
          abs((row["momentum x"] + 0.1 * row["momentum z"]) / (2 * (0.2 - 0.1) * falls) - 1), 5e-5)
below("slides, speed", abs(row["momentum x"] / (2 * (0.2 - 0.1) * falls) - 1), 1e-3)
contact_gives(still, 1e-12)
contact_gives(slides, 1e-12)
finish()
