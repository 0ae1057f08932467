# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random scenes of round bodies that roll between others."""

from . import parts
from .materials import settings
from .motions import Motion
from .round_geometry import Cylinder
from .scene import Body, Condition, Obstacle, Pair, Scene
from .stacks import STILL


def _stuff(rng, beside=1000.0):
    """What turns takes a law that turns with it."""
    return {"Law": "neo-Hookean", "Poisson ratio": "0.3"}, {"Young modulus": beside * rng.choice((1, 1, 3))}


def rolled(rng):
    """A ball or cylinder that a plate presses onto a plane or a base, and rolls over it, by up to 35 degrees."""
    # Pressed so far that several slave nodes touch: on one or two of them it could balance in many ways.
    r = rng.uniform(0.4, 0.6)
    if rng.random() < 0.6:
        roller, side = parts.Ball((0.0, 0.0, r), r, (3, 2)), "surface"
    else:
        roller = Cylinder(1, (0.0, 0.0, r), -0.4, 0.4, r, (4, 1, 2))
        side = "side"
    motion = Motion(rng, ("slide", "slide", "reverse"), rng.uniform(0.1, 0.16) * r, 1.2 * r)
    if side == "side":
        motion.direction = 0.0
    x, y = motion.across()
    coefficient = rng.choice((0.3, 0.5, 1.0))
    bodies, obstacles, pairs = [Body("roller", roller, *_stuff(rng))], [], []

    def meet(name, other, boundaries):
        own = ("roller", (side,), other, boundaries)
        if boundaries and rng.random() < 0.3:
            own = (other, boundaries, "roller", (side,))
        pairs.append(Pair(name, *own, settings(rng), "coulomb", coefficient))

    if rng.random() < 0.5:
        obstacles.append(Obstacle("floor", "plane", (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), STILL))
        meet("lowpair", "floor", ())
    else:
        base = parts.Box((-1.2, -0.7, -0.5), (1.2, 0.8, 0.0), (rng.randint(12, 15), 8, 2))
        bodies.append(Body("base", base, *_stuff(rng), fixed=("bottom",)))
        meet("lowpair", "base", ("top",))
    plate = parts.Box((-1.3, -0.8, 2 * r), (1.2, 0.7, 2 * r + 0.4), (rng.randint(12, 15), 8, 2))
    bodies.append(Body("press", plate, *_stuff(rng), conditions=(("top", Condition(
        (x, y, motion.down()))),)))
    meet("highpair", "press", ("bottom",))
    return Scene("Rolled, " + motion.kind, tuple(bodies), tuple(obstacles), tuple(pairs),
                 motion.end_time, motion.end_time * rng.randint(2, 5))
