# SPDX-License-Identifier: LGPL-2.1-or-later
"""A scene as data: it can be rotated, mirrored, rescaled and written."""

import dataclasses
import math
import re

from .geometry import AXES, NotExpressible, mirror, number, numbers, rotate, scale


@dataclasses.dataclass(frozen=True)
class Formula:
    """A number times a formula of x, y, z and t; without the number, zero."""
    factor: float
    text: str = "1"

    def __str__(self):
        return "0" if self.factor == 0 else f"{number(self.factor)} * ({self.text})"

    def replaced(self, names):
        """Other coordinates for x, y and z."""
        return Formula(self.factor, re.sub(r"\b([xyz])\b", lambda m: names[m[1]], self.text))

    def scaled(self, value, length):
        text = self.replaced({a: f"({a} / {number(length)})" for a in AXES}).text
        return Formula(self.factor * value, self.text if length == 1 else text)

    def warped(self, time):
        """With another time for t."""
        return Formula(self.factor, re.sub(r"\bt\b", time, self.text))

    def at(self, t):
        """Of a formula of t alone."""
        functions = {"min": min, "max": max, "abs": abs, "sin": math.sin, "cos": math.cos,
                     "pi": math.pi, "t": t}
        return self.factor * eval(self.text, {"__builtins__": {}}, functions)  # pylint: disable=eval-used


def rotated_vector(v):
    return tuple(f and f.replaced(dict(zip("xyz", "yzx"))) for f in rotate(v))


def mirrored_vector(v):
    names = {"x": "x", "y": "y", "z": "(-z)"}
    v = tuple(f and f.replaced(names) for f in v)
    return (v[0], v[1], v[2] and Formula(-v[2].factor, v[2].text))


@dataclasses.dataclass(frozen=True)
class Condition:
    """What is prescribed on a boundary; None leaves a component free. Pressure acts on the
    reference area, so that the resultant is known."""
    displacement: tuple = (None, None, None)
    traction: tuple = (None, None, None)

    def bounded(self, stress):
        """With components of the traction of @p stress at most."""
        return Condition(self.displacement, tuple(
            f and Formula(math.copysign(min(abs(f.factor), stress), f.factor), f.text)
            for f in self.traction))

    def keys(self):
        return {f"{kind} {a}": str(f) for kind, v in (("Displacement", self.displacement),
                                                      ("Traction", self.traction))
                for a, f in zip(AXES, v) if f is not None}


@dataclasses.dataclass(frozen=True)
class Body:
    name: str
    geometry: object
    material: dict  # without units: 'Law', 'Poisson ratio'
    moduli: dict  # in units of stress
    fixed: tuple = ()
    symmetry: tuple = ()
    conditions: tuple = ()  # pairs of boundary and Condition

    def renamed(self, geometry, names, vector):
        def new(name):
            return names.get(name, name)

        return dataclasses.replace(
            self, geometry=geometry, fixed=tuple(map(new, self.fixed)),
            symmetry=tuple(map(new, self.symmetry)),
            conditions=tuple((new(b), Condition(vector(c.displacement), vector(c.traction)))
                             for b, c in self.conditions))


@dataclasses.dataclass(frozen=True)
class Obstacle:
    name: str
    shape: str
    point: tuple
    direction: tuple
    motion: tuple
    radius: float = 1.0
    side: str = "outside"


@dataclasses.dataclass(frozen=True)
class Pair:
    name: str
    slave: str
    slave_boundaries: tuple
    master: str  # a body or an obstacle
    master_boundaries: tuple = ()
    settings: tuple = ()  # pairs of key and value without units
    behaviour: str = "frictionless"
    coefficient: float = 0.0  # of friction, or shear strength in units of stress


@dataclasses.dataclass(frozen=True)
class Scene:
    title: str
    bodies: tuple
    obstacles: tuple
    pairs: tuple
    end_time: float
    steps: int
    settings: tuple = ()  # ("Section/Key", value)
    ends: tuple = ()  # of the steps, if they are not equal
    # The smallest distance of the shapes that are placed; negative: their overlap. None if the
    # scene does not know it.
    clearance: float = None
    # How vectors of this scene are those of the one it was made from: signed axes, units.
    axes: tuple = ((0, 1), (1, 1), (2, 1))
    length: float = 1.0
    stress: float = 1.0

    def frictional(self):
        return any(p.behaviour != "frictionless" for p in self.pairs)

    def size(self):
        return max(b.geometry.size() for b in self.bodies)

    def number_of_cells(self):
        return sum(b.geometry.number_of_cells() for b in self.bodies)

    def stiffness(self):
        """A force that would deform the bodies much."""
        return max(b.moduli["Young modulus"] for b in self.bodies) * self.size() ** 2

    def back(self, vector, pseudo=False, unit=1.0):
        """A vector of this scene in the axes and units of the original."""
        sign = math.prod(s for _, s in self.axes) if pseudo else 1
        result = [0.0] * 3
        for value, (axis, s) in zip(vector, self.axes):
            result[axis] = sign * s * value / unit
        return tuple(result)

    def rotated(self):
        """@throws NotExpressible"""
        return self._moved("rotated", rotate, rotated_vector, rotate(self.axes))

    def mirrored(self):
        """@throws NotExpressible"""
        last = (self.axes[2][0], -self.axes[2][1])
        return self._moved("mirrored", mirror, mirrored_vector, self.axes[:2] + (last,))

    def _moved(self, how, vector, formulas, axes):
        names, bodies = {}, []
        for body in self.bodies:
            geometry, names[body.name] = getattr(body.geometry, how)()
            bodies.append(body.renamed(geometry, names[body.name], formulas))
        obstacles = tuple(dataclasses.replace(o, point=vector(o.point),
                                              direction=vector(o.direction),
                                              motion=formulas(o.motion)) for o in self.obstacles)

        def new(body, boundaries):
            return tuple(names.get(body, {}).get(b, b) for b in boundaries)

        pairs = tuple(dataclasses.replace(
            p, slave_boundaries=new(p.slave, p.slave_boundaries),
            master_boundaries=new(p.master, p.master_boundaries)) for p in self.pairs)
        return dataclasses.replace(self, bodies=tuple(bodies), obstacles=obstacles, pairs=pairs,
                                   axes=axes)

    def rescaled(self, length, stress):
        """In other units: numbers of lengths and stresses times these factors."""
        def vector(v, unit):
            return tuple(f and f.scaled(unit, length) for f in v)

        bodies = tuple(dataclasses.replace(
            b, geometry=b.geometry.scaled(length),
            moduli={k: v * stress for k, v in b.moduli.items()},
            conditions=tuple((n, Condition(vector(c.displacement, length),
                                           vector(c.traction, stress)))
                             for n, c in b.conditions)) for b in self.bodies)
        obstacles = tuple(dataclasses.replace(
            o, point=scale(o.point, length), radius=o.radius * length,
            motion=vector(o.motion, length)) for o in self.obstacles)
        pairs = tuple(dataclasses.replace(p, coefficient=p.coefficient * stress)
                      if p.behaviour == "tresca" else p for p in self.pairs)
        clearance = None if self.clearance is None else self.clearance * length
        return dataclasses.replace(self, bodies=bodies, obstacles=obstacles, pairs=pairs,
                                   clearance=clearance, length=self.length * length, stress=self.stress * stress)

    def paused(self):
        """With a step more in the middle, in which nothing moves.
        @throws NotExpressible"""
        if self.steps < 2 or self.ends:
            raise NotExpressible("there are no steps between which to rest")
        step, before = self.end_time / self.steps, self.steps // 2
        low, middle, high = (number((before + part) * step) for part in (0, 0.5, 1))
        time = f"(min(t, {low}) + 2 * max(0, min(t, {high}) - {middle}) + max(0, t - {high}))"

        def vector(v):
            return tuple(f and f.warped(time) for f in v)

        bodies = tuple(dataclasses.replace(b, conditions=tuple(
            (n, Condition(vector(c.displacement), vector(c.traction))) for n, c in b.conditions)) for b in self.bodies)
        obstacles = tuple(dataclasses.replace(o, motion=vector(o.motion)) for o in self.obstacles)
        ends = sorted([(k + 1) * step for k in range(self.steps)] + [(before + 0.5) * step])
        return dataclasses.replace(self, bodies=bodies, obstacles=obstacles, ends=tuple(ends))

    def with_sides(self):
        """Pairs with all boundaries beside those that touch, as users name them to be safe.
        @throws NotExpressible"""
        bodies = {b.name: b for b in self.bodies}
        if any(p.master not in bodies for p in self.pairs):
            raise NotExpressible("an obstacle has no boundaries")
        used = {(p.slave, b) for p in self.pairs for b in p.slave_boundaries}
        used |= {(p.master, b) for p in self.pairs for b in p.master_boundaries}

        def more(name, boundaries):
            body = bodies[name]
            if not hasattr(body.geometry, "beside"):
                return boundaries
            held = {*body.fixed, *body.symmetry, *(b for b, _ in body.conditions)}
            return boundaries + tuple(b for b in body.geometry.beside(boundaries[0])
                                      if b not in held and (name, b) not in used)

        pairs = tuple(dataclasses.replace(
            p, slave_boundaries=more(p.slave, p.slave_boundaries),
            master_boundaries=more(p.master, p.master_boundaries)) for p in self.pairs)
        if pairs == self.pairs:
            raise NotExpressible("no boundary beside")
        return dataclasses.replace(self, pairs=pairs)

    def load(self, body, t):
        """Resultant of the tractions on a body."""
        total = [0.0] * 3
        for boundary, condition in body.conditions:
            for d, f in enumerate(condition.traction):
                if f is not None:
                    total[d] += f.at(t) * body.geometry.area(boundary)
        return tuple(total)
