# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random scenes of round bodies in each other, and of rigid shapes."""

import math

from . import parts
from .materials import behaviour, material, settings
from .motions import MOVED, Motion
from .scene import Body, Condition, Formula, Obstacle, Pair, Scene

STILL = (Formula(0.0),) * 3


def along(axis, formula, other=Formula(0.0)):
    return tuple(formula if d == axis else other for d in range(3))


def _pair(rng, a, a_boundaries, b, b_boundaries):
    if rng.random() < 0.5:
        a, a_boundaries, b, b_boundaries = b, b_boundaries, a, a_boundaries
    law, coefficient = behaviour(rng)
    return Pair("fit", a, a_boundaries, b, b_boundaries, settings(rng), law, coefficient)


def fit(rng):
    """A tube or shaft in another tube: an overlap or a gap, pushed along or turned."""
    axis = rng.randrange(3)
    whole = rng.random() < 0.4
    slope = rng.choice((0.0, 0.0, round(rng.uniform(-0.05, 0.05), 4)))
    overlap = rng.choice((0.0, rng.uniform(0.0005, 0.01), rng.uniform(-0.003, 0)))
    length = rng.uniform(0.5, 1.5)
    origin = (0.0, 0.0, 0.0)
    angle = 360 if whole else 90
    around = (8, 14) if whole else (3, 7)
    outer = parts.Tube(axis, origin, 0.0, length, 1.0, rng.uniform(1.3, 1.8),
                       (2, rng.randint(*around), rng.randint(2, 4)), inner_slope=slope, angle=angle)
    shift = rng.choice((0.0, 0.0, 0.3 * length))
    # What is driven or fixed is not in contact, so that no condition contradicts another one.
    if slope == 0 and rng.random() < 0.4:
        shift = 0.55 * length if whole else shift
        inner = parts.Cylinder(axis, origin, shift, length + shift, 1.0 + overlap,
                               (2, 1, 4 if whole else rng.randint(2, 4)), "full" if whole else "quarter")
        inner_contact, end = ("side",), "end"
    else:
        inner = parts.Tube(axis, origin, shift, length + shift, rng.uniform(0.4, 0.7), 1.0 + overlap,
                           (2, rng.randint(*around), rng.randint(2, 4)), outer_slope=slope,
                           angle=angle)
        inner_contact, end = ("outer",), "inner" if whole else "end"
    _, stuff = material(rng)
    _, other = material(rng, stuff[1]["Young modulus"])
    cuts = () if whole else ("first cut", "second cut")
    move = rng.choice(("rest", "push", "turn") if whole else ("rest", "push"))
    still = STILL if whole else along(axis, Formula(0.0), None)
    if move == "push":
        way = Formula(rng.choice((-1, 1)) * 0.2 * length * rng.uniform(0.1, 1), MOVED)
        still = along(axis, way, Formula(0.0) if whole else None)
    elif move == "turn":
        a, b = "xyz"[(axis + 1) % 3], "xyz"[(axis + 2) % 3]
        angle = f"{math.radians(rng.uniform(1, 20)):.6g} * {MOVED}"
        turn = [Formula(0.0)] * 3
        turn[(axis + 1) % 3] = Formula(1.0, f"(cos({angle}) - 1) * {a} - sin({angle}) * {b}")
        turn[(axis + 2) % 3] = Formula(1.0, f"sin({angle}) * {a} + (cos({angle}) - 1) * {b}")
        still = tuple(turn)
    end_time = 1 if move == "rest" else 2
    bodies = (Body("outer", outer, *stuff, fixed=("outer",) if whole else (),
                   symmetry=cuts if whole else cuts + ("start",)),
              Body("inner", inner, *other, symmetry=cuts, conditions=((end, Condition(still)),)))
    return Scene(f"Fit, {move}", bodies, (), (_pair(rng, "outer", ("inner",), "inner",
                                                  inner_contact),),
                 end_time, end_time * rng.randint(1, 4), clearance=-overlap)


def rigid(rng):
    """A rigid sphere or cylinder that is pressed into a box and moved over it."""
    strain, stuff = material(rng)
    part = parts.below(rng, 1.0)
    while part.curved:
        part = parts.below(rng, 1.0)
    shape = rng.choice(("sphere", "cylinder"))
    radius = rng.uniform(0.6, 2.0)
    at = (rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3))
    motion = Motion(rng, ("press", "slide", "reverse", "lift off"), 2 * strain, 0.3)
    obstacle = Obstacle("punch", shape, (*at, radius), rng.choice(((1.0, 0.0, 0.0), (0.0, 1.0, 0.0),
                                                                (1.0, 1.0, 0.0))),
                        (*motion.across(), motion.down()), radius)
    law, coefficient = behaviour(rng)
    pair = Pair("contact", "low", part.contact, "punch", (), settings(rng), law, coefficient)
    body = Body("low", part.geometry, *stuff, fixed=part.support)
    return Scene(f"Rigid {shape}, {motion.kind}", (body,), (obstacle,), (pair,), motion.end_time,
                 motion.end_time * rng.randint(2, 4))


def between(rng):
    """A ball or box that contact alone holds between two bodies or planes."""
    strain, stuff = material(rng)
    h = rng.uniform(0.6, 1.0)
    motion = Motion(rng, ("press", "slide"), 2 * strain * h, 0.05)
    x, y = motion.across()
    law, coefficient = behaviour(rng)
    if law != "frictionless" and rng.random() < 0.5:
        middle = parts.Ball((0.0, 0.0, h / 2), h / 2, (2, 1))
        low = high = "surface"
    else:
        middle = parts.Box((-h / 2, -h / 2, 0.0), (h / 2, h / 2, h), parts.cells(rng, 2, 3),
                           parts.grading(rng))
        low, high = "bottom", "top"
    # Without friction nothing but these planes would keep it from sliding.
    planes = ("left", "front") if law == "frictionless" else ()
    bodies, pairs = [Body("middle", middle, *stuff, symmetry=planes)], []
    obstacles = [Obstacle("floor", "plane", (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), STILL)]
    pairs.append(Pair("lowpair", "middle", (low,), "floor", (), settings(rng), law, coefficient))
    if rng.random() < 0.5:
        obstacles.append(Obstacle("press", "plane", (0.0, 0.0, h), (0.0, 0.0, -1.0),
                                  (x, y, motion.down())))
        pairs.append(Pair("highpair", "middle", (high,), "press", (), settings(rng), law,
                          coefficient))
    else:
        _, own = material(rng, stuff[1]["Young modulus"])
        plate = parts.Box((-0.8, -0.7, h), (0.7, 0.8, h + 0.4), (4, 4, 2))
        bodies.append(Body("press", plate, *own, conditions=(("top", Condition(
            (x, y, motion.down()))),)))
        pairs.append(Pair("highpair", "middle", (high,), "press", ("bottom",), settings(rng), law,
                          coefficient))
    return Scene("Held by contact alone", tuple(bodies), tuple(obstacles), tuple(pairs),
                 motion.end_time, motion.end_time * rng.randint(2, 4))


def bore(rng):
    """A tube or cylinder in a rigid bore, or a tube on a rigid shaft."""
    axis = rng.randrange(3)
    overlap = rng.uniform(0.0005, 0.005)
    tube = parts.Tube(axis, (0.0, 0.0, 0.0), 0.0, 0.8, 0.6, 1.0, (2, rng.randint(8, 12), 3),
                      angle=360, grading=rng.choice((1, 1.5)))
    inside = rng.random() < 0.5
    _, stuff = material(rng)
    way = Formula(rng.uniform(-0.3, 0.3), MOVED)
    moved = along(axis, way)
    if rng.random() < 0.5:
        moved = along((axis + 1) % 3, Formula(rng.uniform(0.001, 0.01), MOVED))
    obstacle = Obstacle("rigid", "cylinder", (0.0, 0.0, 0.0), along(axis, 1.0, 0.0), moved,
                        1.0 - overlap if inside else 0.6 + overlap,
                        "inside" if inside else "outside")
    law, coefficient = behaviour(rng)
    pair = Pair("fit", "tube", ("outer" if inside else "inner",), "rigid", (), settings(rng), law,
                coefficient)
    return Scene("Rigid fit", (Body("tube", tube, *stuff, fixed=("inner" if inside else "outer",)),),
                 (obstacle,), (pair,), 2, 2 * rng.randint(2, 3))
