# SPDX-License-Identifier: LGPL-2.1-or-later
"""Contact of explicit dynamics against exact answers (doc/explicit.md, section 9.7): impacts of
bars, a rod on a wall, friction, a cradle, the patch test, and scenes of implicit dynamics with
another scheme."""

import math

from touchstone_test import (STEPS, below, check, checks, contact_gives, finish, folder, prm, relative, run,
                             stopped_and_resumed, tests)

bars, ball = checks / "explicit_bars.prm", checks / "explicit_ball.prm"
EXPLICIT = {"Time integration/Scheme": "central_differences"}
COURANT = "Time integration/Courant factor"
PAIRING = "Contact pair impact/Pairing"


def impact(result, pair="impact"):
    """Force of each step, and the numbers of the first and the last with contact."""
    force = [abs(value) for value in result.column(f"{pair}: force x")]
    pressed = [k for k, value in enumerate(force) if value > 0]
    check(pressed == list(range(pressed[0], pressed[-1] + 1)), f"{result}: contact opens twice")
    return force, pressed[0], pressed[-1]


# Two equal bars at Courant factor 1. The first and the last force are half cycles of the waves.
for pairing in "pointwise", "averaged":
    for enforcement in "automatic", "defence node":
        two = run(f"bars_{pairing}_{enforcement}", bars,
                  {PAIRING: pairing, "Contact/Enforcement": enforcement})
        force, first, last = impact(two)
        below(f"{two}, stress of the plateau",
              max(abs(value / 0.005 - 1) for value in force[first + 1:last]), 1e-8)
        below(f"{two}, cycles in contact less 2 L / c", abs(last - first + 1 - 40), 1.5)
        contact_gives(two, 1e-12)
        below(f"{two}, energy lost", two.value("motion", "energies", "contact") /
              two.value("motion", "energies", "initial"), 1 / 20)
        below(f"{two}, speed left to the left bar",
              abs(two.value("motion", "velocities", "left", 0)) / 0.01, 1 / 20)
# Courant factor 0.9: 1 % in the plateau.
slower = run("bars_slower", bars, {COURANT: 0.9, "Load stepping/End time": 54, STEPS: 60})
force, first, last = impact(slower)
plateau = force[first + 5:last - 5]
mean = sum(plateau) / len(plateau)
below("bars_slower, mean of the plateau", abs(mean / 0.005 - 1), 0.01)
below("bars_slower, scatter of the plateau",
      math.sqrt(sum((value - mean) ** 2 for value in plateau) / len(plateau)) / mean, 0.01)
contact_gives(slower, 1e-12)
# Bars 1 : 2.
unequal = run("bars_unequal", bars, {"Body left/Geometry/Lower corner": "-10, 0, 0",
                                     "Body left/Geometry/Cells": "10, 1, 1"})
below("bars_unequal, the short one stops",
      abs(unequal.value("motion", "velocities", "left", 0)) / 0.01, 1e-3)
below("bars_unequal, half the speed",
      abs(unequal.value("motion", "velocities", "right", 0) / 0.01 - 0.5), 1e-3)

# A rod on a rigid wall.
rod = run("rod", checks / "explicit_rod.prm")
cycle = 1.7264e-4 / 140
force, first, last = impact(rod)
below("rod, cycles from the exact time of contact", abs(first * cycle - 4.9456e-5) / cycle, 1)
below("rod, cycles from the exact time of release",
      abs((last + 1) * cycle - 1.48114e-4) / cycle, 1.5)
below("rod, force", max(abs(value / 29922.9 - 1) for value in force[first + 2:last - 1]), 0.01)
contact_gives(rod, 1e-12)

# A soft ball on a plane, coarse. A ball is stiffer than Hertz' half space (doc/explicit.md 9.7).
soft = run("ball", ball)
force = [4 * value for value in soft.column("impact: force z")]
below("ball, force", relative(max(force), 117.57), 0.15)
below("ball, time of contact",
      relative(sum(value > 0 for value in force) * 5e-6, 0.39323e-3), 0.03)
check(soft.value("motion", "velocities", "ball", 2) > 0.97 * 3000, "ball: slow rebound")
contact_gives(soft, 1e-12)

# Gross slip: the scene of implicit dynamics with another scheme.
oblique = run("oblique", tests / "oblique_impact.prm", EXPLICIT)
below("oblique, impulse along the plane is not mu times that across",
      relative(oblique.after("  impulse", 1), -0.2 * oblique.after("  impulse", 3)), 1e-3)

contact_gives(oblique, 1e-12)

# A ball comes to roll after 2 v / (7 mu g) with 5/7 of its speed, 0.25 later as gravity grows first.
# Until then its momentum is exact: the force along the plane is 0.1 of that across, which is the weight and
# the change of momentum.
rolling = run("rolling", checks / "explicit_rolling.prm")
rows, exact = rolling.rows(), 2 / (7 * 0.1) + 0.25


def sliding_momentum(at):
    """Momentum along the plane and 0.1 of that across, over what it is with mass 1."""
    time = at["time"] - at["shortest cycle"] / 2
    return (at["momentum x"] + 0.1 * at["momentum z"]) / (
        1 - 0.1 * (time ** 2 if time < 0.5 else time - 0.25))


mass = sliding_momentum(rows[0])
for row in rows:
    if row["time"] < 0.8 * exact:
        below(f"rolling, momentum at {row['time']:g}", relative(sliding_momentum(row), mass), 1e-7)
        check(row["contact: stick nodes"] == 0, f"rolling: sticks at {row['time']:g}")
contact_gives(rolling, 1e-12)
rolls = [row["momentum x"] / mass for row in rows if row["time"] > exact]
below("rolling, speed", relative(sum(rolls) / len(rolls), 5 / 7), 0.01)
below("rolling, speed at the time", relative(rolls[0], 5 / 7), 0.01)

# A cradle: the last bar leaves with the speed of the first, the others rest.
cradle = run("cradle", checks / "explicit_cradle.prm")
below("cradle, the last bar leaves", abs(cradle.value("motion", "velocities", "e", 0) / 0.01 - 1),
      0.06)
for bar in "abcd":
    below(f"cradle, {bar} rests", abs(cradle.value("motion", "velocities", bar, 0)) / 0.01, 0.06)

contact_gives(cradle, 1e-12)

# The patch test of averaged rows, damped to rest.
patch = run("patch", prm / "patch_test.prm",
            {**EXPLICIT, "Body upper/Boundary top/Pressure": 10,
             **{f"Body {body}/Material/{key}": value for body in ("lower", "upper")
                for key, value in (("Density", 1), ("Rayleigh mass", 60))},
             "Load stepping/End time": 3, STEPS: 6})
below("patch, stress", patch.error("stress_max_deviation"), 1e-8)
contact_gives(patch, 1e-12)

# Partners that stay far behind: the block must not sink into its base.
small = run("small_sliding", checks / "explicit_small_sliding.prm")
below("small_sliding, penetration", max(small.column("contact: max penetration")), 1e-6)
below("small_sliding, impulse of the weight", relative(small.after("  impulse", 3), 5 * 0.0897 * 0.5),
      0.05)
contact_gives(small, 1e-12)
# An overlap at rest is pressed apart, up to the force of statics.
apart = run("interference", checks / "explicit_interference.prm")
static = run("interference_static", checks / "explicit_interference.prm",
             {"Time integration/Scheme": "static",
              **{f"Body {body}/Material/Rayleigh mass": 0 for body in ("base", "block")}})
below("interference, force", relative(apart.force("contact")[2], static.force("contact")[2]), 1e-5)
check(apart.value("motion", "energies", "contact") >= 0, "interference: contact gives energy")
contact_gives(apart, 1e-12)
# Slow compression of a driven block: kinetic energy is that of its velocity.
driven = run("compressed", checks / "explicit_interference.prm",
             {"Contact pair contact/Initial overlap": "adjust", "Load stepping/End time": 5,
              "Body block/Fixed": "", "Body block/Boundary conditions": "top",
              "Body block/Boundary top/Displacement z": "-0.02*t"})
check(0 < driven.value("motion", "energies", "kinetic") < 1e-3, "compressed: kinetic energy")
contact_gives(driven, 1e-12)

# Hard cases: no admissible velocity, and a node in a corner of walls.
driven = run("driven", checks / "explicit_driven.prm", fails=True)
for name in "'right' of 'left'", "'left' of 'right'", "driven into each other":
    check(name in driven.text, f"driven: the message does not say {name}")
corner = run("corner", checks / "explicit_corner.prm")
for pair in "xyz":
    below(f"corner, penetration of {pair}", max(corner.column(f"{pair}: max penetration")), 1e-9)
    check(corner.force(pair) != [0, 0, 0] or max(corner.column(f"{pair}: area")) > 0,
          f"corner: no contact with {pair}")
contact_gives(corner, 1e-6)
below("corner, balance error", abs(corner.value("motion", "energies", "balance_error")) /
      corner.value("motion", "energies", "initial"), 1e-3)

# The same bits on any number of ranks: with few cycles, since ranks wait for each other on machines
# with fewer processors. On 4 ranks some have no contact.
for name, scene, several, settings in (
        ("ranks_patch", prm / "patch_test.prm", (2, 3),
         {**EXPLICIT, "Body upper/Boundary top/Pressure": 10, "Body lower/Material/Density": 1,
          "Body upper/Material/Density": 1, "Load stepping/End time": 0.08, STEPS: 4,
          "Contact pair interface/Behaviour": "coulomb",
          "Contact pair interface/Friction/Coefficient": 0.3}),
        ("ranks_corner", checks / "explicit_corner.prm", (2, 4),
         {"Body block/Geometry/Cells": "2, 2, 2", "Load stepping/End time": 0.06, STEPS: 10})):
    one = run(name, scene, settings)
    check(any(max(one.column(f"{pair}: active nodes")) > 0 for pair in ("interface", "x", "z")),
          f"{name}: no contact")
    for ranks in several:
        more = run(f"{name}_{ranks}", scene, settings, ranks)
        check((one.folder / "statistics").read_text(encoding="utf-8") ==
              (more.folder / "statistics").read_text(encoding="utf-8"),
              f"{name}: other results on {ranks} ranks")
    # Stopped after the step before the last checkpoint, and resumed.
    again = stopped_and_resumed(name, scene, settings, every=2)
    check((again.folder / "statistics").read_text(encoding="utf-8") ==
          (one.folder / "statistics").read_text(encoding="utf-8"),
          f"{name}: other results after a restart")

# Supports and the table determine how slave nodes slip: the force is on the cone, whatever holds them.
held = run("held_nodes", checks / "explicit_held_nodes.prm")
for time, along, across in zip(*(held.column(title) for title in
                                 ("time", "rest: force x", "rest: force z"))):
    if time > 0:
        below(f"held nodes at {time}, F_x / F_z differs from mu", relative(along / across, 0.3), 1e-3)

# Plates that part have no rows any more as soon as rows would be made anew: there are planes between them.
SMALL = {f"Body {body}/Geometry/{key}": value for body, key, value in (
    ("upper", "Cells", "8, 8, 1"), ("upper", "Upper corner", "8.004, 8.003, 1.00001"),
    ("lower", "Cells", "8, 8, 1"), ("lower", "Upper corner", "8, 8, 0"))}
plates = run("plates", checks / "explicit_plates.prm", SMALL)
renewals = sum(plates.column("contact renewals"))
print(f"plates: {renewals:g} renewals")
check(1 <= renewals <= 2, f"plates: {renewals:g} renewals of rows")

finish()
