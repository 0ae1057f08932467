# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies with curved boundaries; see geometry.py for what they have in common."""

import dataclasses
import math

from .geometry import AXES, NotExpressible, mirror, number, numbers, rotate, sagitta_of, scale


@dataclasses.dataclass(frozen=True)
class Tube:
    """A tube or a sector of it; cells radial, angular, axial."""
    axis: int
    origin: tuple
    start: float
    end: float
    inner: float
    outer: float
    cells: tuple
    inner_slope: float = 0.0
    outer_slope: float = 0.0
    first_angle: float = 0.0
    angle: float = 90.0
    grading: float = 1.0

    def beside(self, boundary):
        """The boundaries that share an edge with this one, but for cuts."""
        return ("start", "end") if boundary in ("inner", "outer") else ("inner", "outer")

    def keys(self):
        return {"Type": "tube", "Axis": AXES[self.axis], "Origin": numbers(self.origin),
                "Start": number(self.start), "End": number(self.end),
                "Inner radius": number(self.inner), "Inner slope": number(self.inner_slope),
                "Outer radius": number(self.outer), "Outer slope": number(self.outer_slope),
                "First angle": number(self.first_angle), "Angle": number(self.angle),
                "Cells": numbers(self.cells), "Radial grading": number(self.grading)}

    def rotated(self):
        return dataclasses.replace(self, axis=(self.axis + 1) % 3, origin=rotate(self.origin)), {}

    def mirrored(self):
        moved = dataclasses.replace(self, origin=mirror(self.origin))
        if self.axis == 2:
            return dataclasses.replace(moved, start=-self.end, end=-self.start,
                                       inner_slope=-self.inner_slope,
                                       outer_slope=-self.outer_slope), \
                {"start": "end", "end": "start"}
        # Angles go from y to z about x, from z to x about y.
        base = 0 if self.axis == 0 else 180
        first = (base - self.first_angle - self.angle) % 360
        return dataclasses.replace(moved, first_angle=first), \
            {"first cut": "second cut", "second cut": "first cut"}

    def scaled(self, f):
        return dataclasses.replace(self, origin=scale(self.origin, f), start=f * self.start,
                                   end=f * self.end, inner=f * self.inner, outer=f * self.outer)

    def size(self):
        return math.hypot(2 * self.outer, self.end - self.start)

    def sagitta(self):
        return sagitta_of(self.outer, self.angle / self.cells[1])

    def number_of_cells(self):
        return math.prod(self.cells)


@dataclasses.dataclass(frozen=True)
class Cylinder:
    """A solid cylinder; cells of the core, from the core to the side, axial."""
    axis: int
    origin: tuple
    start: float
    end: float
    radius: float
    cells: tuple
    part: str = "full"
    grading: float = 1.0

    def beside(self, boundary):
        """The boundaries that share an edge with this one, but for cuts."""
        return ("start", "end") if boundary == "side" else ("side",)

    def keys(self):
        return {"Type": "cylinder", "Axis": AXES[self.axis], "Origin": numbers(self.origin),
                "Start": number(self.start), "End": number(self.end),
                "Radius": number(self.radius), "Part": self.part, "Cells": numbers(self.cells),
                "Axial grading": number(self.grading)}

    def rotated(self):
        return dataclasses.replace(self, axis=(self.axis + 1) % 3, origin=rotate(self.origin)), {}

    def mirrored(self):
        moved = dataclasses.replace(self, origin=mirror(self.origin))
        if self.axis == 2:
            return dataclasses.replace(moved, start=-self.end, end=-self.start,
                                       grading=1 / self.grading), {"start": "end", "end": "start"}
        if self.part != "full":
            raise NotExpressible("the angles of a part are given")
        return moved, {}

    def scaled(self, f):
        return dataclasses.replace(self, origin=scale(self.origin, f), start=f * self.start,
                                   end=f * self.end, radius=f * self.radius)

    def size(self):
        return math.hypot(2 * self.radius, self.end - self.start)

    def sagitta(self):
        return sagitta_of(self.radius, 45 / self.cells[0])

    def number_of_cells(self):
        core, shell, axial = self.cells
        return 4 * (core * core + 2 * core * shell) * axial


@dataclasses.dataclass(frozen=True)
class Ball:
    """A ball or a part of it; cells of the core and from the core to the surface."""
    centre: tuple
    radius: float
    cells: tuple
    keep: tuple = ("both", "both", "both")

    def keys(self):
        return {"Type": "ball", "Centre": numbers(self.centre), "Radius": number(self.radius),
                "Keep": ", ".join(self.keep), "Cells": numbers(self.cells)}

    def rotated(self):
        names = {f"{a} cut": f"{b} cut" for a, b in zip("xyz", "yzx")}
        return dataclasses.replace(self, centre=rotate(self.centre), keep=rotate(self.keep)), names

    def mirrored(self):
        other = {"both": "both", "+": "-", "-": "+"}[self.keep[2]]
        return dataclasses.replace(self, centre=mirror(self.centre),
                                   keep=(self.keep[0], self.keep[1], other)), {}

    def scaled(self, f):
        return dataclasses.replace(self, centre=scale(self.centre, f), radius=f * self.radius)

    def size(self):
        return 2 * self.radius

    def sagitta(self):
        return 2 * sagitta_of(self.radius, 45 / self.cells[0])

    def number_of_cells(self):
        core, shell = self.cells
        parts = 2 ** sum(k == "both" for k in self.keep)
        return parts * (core ** 3 + 3 * core * core * shell)


@dataclasses.dataclass(frozen=True)
class Cap:
    """A block with a round or flat contact face, graded towards the apex. It always stands
    along z."""
    apex: tuple
    shape: str
    radius: float
    side: str
    part: str
    width: float
    height: float
    cells: tuple  # contact, outer, contact layers, outer layers
    depth: float = 1.0
    depth_cells: int = 1
    contact_width: float = 0.25

    def keys(self):
        names = ("Contact cells", "Outer cells", "Contact layers", "Outer layers")
        result = {"Type": "cap", "Apex": numbers(self.apex), "Shape": self.shape,
                  "Radius": number(self.radius), "Contact side": self.side, "Part": self.part,
                  "Width": number(self.width), "Height": number(self.height),
                  "Contact width": number(self.contact_width)}
        if self.shape == "cylinder":
            result |= {"Depth": number(self.depth), "Depth cells": str(self.depth_cells)}
        return result | {name: str(n) for name, n in zip(names, self.cells)}

    def rotated(self):
        raise NotExpressible("a cap stands along z")

    def mirrored(self):
        side = {"bottom": "top", "top": "bottom"}[self.side]
        return dataclasses.replace(self, apex=mirror(self.apex), side=side), {}

    def scaled(self, f):
        return dataclasses.replace(self, apex=scale(self.apex, f), radius=f * self.radius,
                                   width=f * self.width, height=f * self.height,
                                   depth=f * self.depth, contact_width=f * self.contact_width)

    def size(self):
        return math.hypot(2 * self.width, self.height)

    def sagitta(self):
        return (self.width / self.cells[1]) ** 2 / (4 * self.radius) if self.radius else 0.0

    def number_of_cells(self):
        across = self.cells[0] + self.cells[1]
        whole = 1 if self.part == "quarter" else 2
        section = whole * across * (self.depth_cells if self.shape == "cylinder" else
                                    whole * across)
        return section * (self.cells[2] + self.cells[3])


@dataclasses.dataclass(frozen=True)
class RoundedPlate:
    """A plate with one corner rounded."""
    corner: tuple
    first: tuple
    second: tuple
    lengths: tuple
    thickness: float
    radius: float
    cells: tuple
    layers: int = 1

    def keys(self):
        return {"Type": "rounded plate", "Corner": numbers(self.corner),
                "First direction": numbers(self.first), "Second direction": numbers(self.second),
                "Side lengths": numbers(self.lengths), "Thickness": number(self.thickness),
                "Corner radius": number(self.radius), "Cells": numbers(self.cells),
                "Layers": str(self.layers)}

    def rotated(self):
        return dataclasses.replace(self, corner=rotate(self.corner), first=rotate(self.first),
                                   second=rotate(self.second)), {}

    def mirrored(self):
        return dataclasses.replace(self, corner=mirror(self.corner), first=mirror(self.first),
                                   second=mirror(self.second)), {"front": "back", "back": "front"}

    def scaled(self, f):
        return dataclasses.replace(self, corner=scale(self.corner, f), radius=f * self.radius,
                                   lengths=scale(self.lengths, f), thickness=f * self.thickness)

    def size(self):
        return math.hypot(*self.lengths)

    def sagitta(self):
        return sagitta_of(self.radius, 22.5)

    def number_of_cells(self):
        a, b = self.cells
        return ((a + 2) * (b + 2) + 2 * (a + b + 4)) * self.layers
