# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random bodies to be put together: below z = 0 with the contact on top, or above z = 0
with the contact below."""

import dataclasses
import math

from .geometry import Block, Box
from .round_geometry import Ball, Cap, Cylinder, RoundedPlate, Tube


@dataclasses.dataclass(frozen=True)
class Part:
    geometry: object
    contact: tuple
    support: tuple  # boundaries opposite to the contact
    height: float
    half_width: float
    curved: bool
    flat_top: bool = False  # one plane boundary whose area is known


def cells(rng, low, high, n=3):
    return tuple(rng.randint(low, high) for _ in range(n))


def grading(rng):
    return rng.choice(((1, 1, 1), (1, 1, 1), (round(rng.uniform(0.4, 2.5), 3), 1,
                                              round(rng.uniform(0.4, 2.5), 3))))


def _box_above(rng, r, at):
    a, b, h = r * rng.uniform(0.4, 1), r * rng.uniform(0.4, 1), r * rng.uniform(0.4, 1.5)
    lower, upper = (at[0] - a, at[1] - b, 0.0), (at[0] + a, at[1] + b, h)
    rotation = (0, 0, rng.choice((0, round(rng.uniform(1, 60), 2))))
    if rotation[2]:
        # It turns about its lower corner; its middle stays.
        c, s = math.cos(math.radians(rotation[2])), math.sin(math.radians(rotation[2]))
        lower = (at[0] - c * a + s * b, at[1] - s * a - c * b, 0.0)
        upper = (lower[0] + 2 * a, lower[1] + 2 * b, h)
    return Part(Box(lower, upper, cells(rng, 2, 4), grading(rng), rotation),
                ("bottom",), ("top",), h, min(a, b), False, True)


def _block_above(rng, r, at):
    h, corners = r * rng.uniform(0.5, 1.2), []
    for z, size in ((0.0, 1.0), (h, rng.uniform(0.7, 1.2))):
        shift = (0, 0) if z == 0 else (rng.uniform(-0.2, 0.2) * r, rng.uniform(-0.2, 0.2) * r)
        for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            f = 0.7 * r * size * rng.uniform(0.8, 1.1)
            corners.append((at[0] + shift[0] + f * x, at[1] + shift[1] + f * y, z))
    return Part(Block(tuple(corners), cells(rng, 2, 4), grading(rng)), ("bottom",), ("top",), h,
                0.5 * r, False, True)


def _ball_above(rng, r, at):
    return Part(Ball((at[0], at[1], r), r, (2, rng.randint(1, 2)), ("both", "both", "-")),
                ("surface",), ("z cut",), r, r, True)


def _cap_above(rng, r, at):
    shape = rng.choice(("sphere", "cylinder"))
    curved = rng.random() < 0.8
    cap = Cap((at[0], at[1] - (r / 2 if shape == "cylinder" else 0), 0.0), shape,
              2.5 * r if curved else 0.0, "bottom", "whole", r, r,
              (rng.randint(1, 2), 2, 2, 2), r, rng.randint(1, 3), 0.3 * r)
    return Part(cap, ("contact",), ("far",), r, r, curved)


def _tube_above(rng, r, at):
    """The lower half of a lying tube."""
    axis = rng.choice((0, 1))
    tube = Tube(axis, (at[0], at[1], r), -0.6 * r, 0.6 * r, 0.5 * r, r,
                (2, rng.randint(5, 8), rng.randint(2, 3)), first_angle=180 if axis == 0 else 90,
                angle=180, grading=rng.choice((1, 1, 1.5)))
    return Part(tube, ("outer",), ("first cut", "second cut"), r, 0.6 * r, True)


def _cylinder_above(rng, r, at):
    h = r * rng.uniform(0.6, 1.5)
    cylinder = Cylinder(2, (at[0], at[1], 0.0), 0.0, h, 0.8 * r, (rng.randint(1, 2), 1,
                                                                rng.randint(2, 3)),
                        grading=rng.choice((1, 1, 2)))
    return Part(cylinder, ("start",), ("end",), h, 0.8 * r, False)


def _ring_above(rng, r, at):
    """A standing tube."""
    h = r * rng.uniform(0.6, 1.2)
    tube = Tube(2, (at[0], at[1], 0.0), 0.0, h, 0.5 * r, r, (2, rng.randint(8, 12), 2), angle=360,
                inner_slope=rng.choice((0, 0.1)))
    return Part(tube, ("start",), ("end",), h, r, False)


def _plate_above(rng, r, at):
    plate = RoundedPlate((at[0] - r, at[1], 0.0), (1, 0, 0), (0, 0, 1), (2 * r, r), 0.8 * r, 0.3 * r,
                         (3, 2), 2)
    return Part(plate, ("first side", "fillet"), ("far first side",), r, 0.4 * r, True)


def _box_below(rng, r):
    a, b, h = r * rng.uniform(1, 1.6), r * rng.uniform(1, 1.6), r * rng.uniform(0.5, 1.2)
    return Part(Box((-a, -b, -h), (a, b, 0.0), cells(rng, 3, 5, 2) + (rng.randint(2, 3),),
                    grading(rng)), ("top",), ("bottom",), h, min(a, b), False, True)


def _block_below(rng, r):
    h, corners = r * rng.uniform(0.5, 1.2), []
    for z in (-h, 0.0):
        for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            f = 1.3 * r * rng.uniform(0.85, 1.15)
            corners.append((f * x, f * y, z))
    return Part(Block(tuple(corners), cells(rng, 3, 5, 2) + (2,)), ("top",), ("bottom",), h, r,
                False, True)


def _ball_below(rng, r):
    return Part(Ball((0.0, 0.0, -r), r, (2, 2), ("both", "both", "+")), ("surface",), ("z cut",),
                r, r, True)


def _cylinder_below(rng, r):
    """The upper half of a lying cylinder."""
    cylinder = Cylinder(0, (0.0, 0.0, -r), -1.2 * r, 1.2 * r, r, (1, 2, rng.randint(3, 5)), "half")
    return Part(cylinder, ("side",), ("first cut",), r, r, True)


def _bore_below(rng, r):
    """A lying half bore, in which things lie."""
    outer = rng.uniform(2.2, 2.8) * r
    tube = Tube(0, (0.0, 0.0, 1.6 * r), -1.2 * r, 1.2 * r, 1.6 * r, outer,
                (2, rng.randint(5, 8), 3), first_angle=180, angle=180)
    return Part(tube, ("inner",), ("outer",), outer - 1.6 * r, r, True)


ABOVE = (_box_above, _box_above, _block_above, _ball_above, _cap_above, _tube_above,
         _cylinder_above, _ring_above, _plate_above)
BELOW = (_box_below, _box_below, _block_below, _ball_below, _cylinder_below, _bore_below)
# What fits into a bore.
ROUND_ABOVE = (_ball_above, _tube_above)


def above(rng, size, at=(0.0, 0.0), choice=ABOVE):
    return rng.choice(choice)(rng, size, at)


def below(rng, size):
    return rng.choice(BELOW)(rng, size)
