# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies of plane faces, and what all geometries can do.

Each geometry can be rotated (x to y, y to z, z to x), mirrored (z to -z) and scaled. As
boundaries are named by direction or by the order of angles, each of these also says which
boundary has which name afterwards; what a geometry cannot express is NotExpressible.
"""

import dataclasses
import math

AXES = "xyz"
SIDES = ("left", "right", "front", "back", "bottom", "top")


class NotExpressible(Exception):
    """The geometry has no keys for what it would be after the transformation."""


def rotate(v):
    """What was along x is along y afterwards, y along z, z along x."""
    return (v[2], v[0], v[1])


def mirror(v):
    return (v[0], v[1], -v[2])


def scale(v, factor):
    return tuple(factor * c for c in v)


def cross(a, b):
    return tuple(a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]
                 for i in range(3))


def difference(a, b):
    return tuple(p - q for p, q in zip(a, b))


def norm(v):
    return math.sqrt(sum(c * c for c in v))


def number(value):
    return f"{value:.15g}"


def numbers(values):
    return ", ".join(number(v) for v in values)


def sagitta_of(radius, degrees):
    """Of the facet that spans this angle."""
    return radius * (1 - math.cos(math.radians(degrees) / 2))


def turned(v, degrees):
    """Turned about x, then y, then z."""
    for axis, angle in enumerate(degrees):
        a, b = (axis + 1) % 3, (axis + 2) % 3
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        w = list(v)
        w[a], w[b] = c * v[a] - s * v[b], s * v[a] + c * v[b]
        v = tuple(w)
    return v


@dataclasses.dataclass(frozen=True)
class Box:
    """A box along the axes, or turned about its lower corner."""
    lower: tuple
    upper: tuple
    cells: tuple
    grading: tuple = (1, 1, 1)
    rotation: tuple = (0, 0, 0)

    def beside(self, boundary):
        """The boundaries that share an edge with this one."""
        pair = SIDES.index(boundary) // 2
        return SIDES[:2 * pair] + SIDES[2 * pair + 2:]

    def keys(self):
        result = {"Type": "box", "Lower corner": numbers(self.lower),
                  "Upper corner": numbers(self.upper), "Cells": numbers(self.cells)}
        if self.grading != (1, 1, 1):
            result["Grading"] = numbers(self.grading)
        if self.rotation != (0, 0, 0):
            result["Rotation"] = numbers(self.rotation)
        return result

    def block(self):
        """The same body by its corners, which can have any direction."""
        size = difference(self.upper, self.lower)
        corners = [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
        return Block(tuple(tuple(o + d for o, d in zip(self.lower, turned(
            tuple(c * s for c, s in zip(corner, size)), self.rotation))) for corner in corners),
            self.cells, self.grading)

    def rotated(self):
        if self.rotation != (0, 0, 0):
            return self.block().rotated()
        # left, right, front, back, bottom, top go on by one direction.
        names = dict(zip(SIDES, SIDES[2:] + SIDES[:2]))
        return Box(rotate(self.lower), rotate(self.upper), rotate(self.cells),
                   rotate(self.grading)), names

    def mirrored(self):
        if self.rotation != (0, 0, 0):
            return self.block().mirrored()
        lower = (self.lower[0], self.lower[1], -self.upper[2])
        upper = (self.upper[0], self.upper[1], -self.lower[2])
        grading = (self.grading[0], self.grading[1], 1 / self.grading[2])
        return (Box(lower, upper, self.cells, grading), {"bottom": "top", "top": "bottom"})

    def scaled(self, factor):
        return dataclasses.replace(self, lower=scale(self.lower, factor),
                                   upper=scale(self.upper, factor))

    def size(self):
        return norm(difference(self.upper, self.lower))

    def area(self, boundary):
        return self.block().area(boundary)

    def sagitta(self):
        """How far facets stray from the shape."""
        return 0.0

    def number_of_cells(self):
        return math.prod(self.cells)


@dataclasses.dataclass(frozen=True)
class Block:
    """Eight corners; its boundaries keep their names however it lies."""
    corners: tuple
    cells: tuple
    grading: tuple = (1, 1, 1)

    beside = Box.beside

    def keys(self):
        result = {"Type": "block", "Corners": "; ".join(numbers(c) for c in self.corners),
                  "Cells": numbers(self.cells)}
        if self.grading != (1, 1, 1):
            result["Grading"] = numbers(self.grading)
        return result

    def rotated(self):
        return dataclasses.replace(self, corners=tuple(rotate(c) for c in self.corners)), {}

    def mirrored(self):
        corners = tuple(mirror(c) for c in self.corners[4:] + self.corners[:4])
        grading = (self.grading[0], self.grading[1], 1 / self.grading[2])
        return Block(corners, self.cells, grading), {"bottom": "top", "top": "bottom"}

    def scaled(self, factor):
        return dataclasses.replace(self, corners=tuple(scale(c, factor) for c in self.corners))

    def size(self):
        return norm(difference(self.corners[6], self.corners[0]))

    def area(self, boundary):
        """Of a plane face."""
        order = {"bottom": (0, 1, 2, 3), "top": (4, 5, 6, 7), "front": (0, 1, 5, 4),
                 "right": (1, 2, 6, 5), "back": (2, 3, 7, 6), "left": (3, 0, 4, 7)}[boundary]
        a, b, c, d = (self.corners[i] for i in order)
        return norm(cross(difference(c, a), difference(d, b))) / 2

    def sagitta(self):
        """How far facets stray from the shape."""
        return 0.0

    def number_of_cells(self):
        return math.prod(self.cells)
