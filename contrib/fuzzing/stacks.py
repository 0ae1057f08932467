# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random scenes of bodies that lie on each other or on an obstacle."""

import dataclasses
import math

from . import parts
from .materials import STRAINS, bearable, behaviour, material, settings
from .motions import KINDS, Motion
from .round_geometry import Tube
from .scene import Body, Condition, Formula, Obstacle, Pair, Scene

STILL = (Formula(0.0),) * 3


def _driven(rng, name, part, motion, stuff, by_force):
    """A body that a motion drives at its support."""
    x, y = motion.across()
    if by_force:
        strain = motion.depth / part.height
        pressure = stuff[1]["Young modulus"] * strain
        condition = Condition((x, y, None), (None, None, motion.force(pressure)))
    else:
        condition = Condition((x, y, motion.down()))
    return Body(name, part.geometry, *stuff, conditions=tuple((b, condition)
                                                              for b in part.support))


def _borne_by(body, *materials, share=1.0):
    """@p body with a load that bodies of these materials bear, on @p share of its area: a soft one
    under a stiff one would be pressed beyond what its law describes, or its balance."""
    stress = share * min(map(bearable, materials))
    return dataclasses.replace(body, conditions=tuple((b, c.bounded(stress))
                                                      for b, c in body.conditions))


def _ground(rng, name="ground"):
    return Obstacle(name, "plane", (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), STILL)


def _pair(rng, name, a, a_boundaries, b, b_boundaries, either=True):
    """Either of both is the slave, unless the other one is an obstacle."""
    if either and rng.random() < 0.5:
        a, a_boundaries, b, b_boundaries = b, b_boundaries, a, a_boundaries
    law, coefficient = behaviour(rng)
    return Pair(name, a, a_boundaries, b, b_boundaries, settings(rng), law, coefficient)


def _clearance(low, top, bore):
    """The smallest gap as they are placed. A tube that lies across a bore reaches into it with its ends."""
    if not bore or not isinstance(top.geometry, Tube) or top.geometry.axis == low.geometry.axis:
        return 0.0
    radius, half = low.geometry.inner, top.geometry.end
    return math.sqrt(radius * radius - half * half) - radius


def two(rng):
    """A body pressed onto another one or onto a plane, and moved over it."""
    rigid = rng.random() < 0.2
    low = None if rigid else parts.below(rng, 1.0)
    bore = low is not None and low.contact == ("inner",)
    offset = 0.0 if low and low.curved else rng.choice((0.0, rng.uniform(-1, 1)))
    top = parts.above(rng, rng.uniform(0.6, 1.0), (offset, rng.choice((0, 1)) * offset / 2),
                      parts.ROUND_ABOVE if bore else parts.ABOVE)
    strain, stuff = material(rng)
    curved = top.curved or (low is not None and low.curved)
    depth = max(2 * strain, 0.04) * top.height if curved else strain * top.height
    far = 0.15 if low and low.curved else rng.choice((0.1, 0.5, 1.2))
    motion = Motion(rng, KINDS, depth, far * top.half_width, (offset, 0.0))
    by_force = top.flat_top and rng.random() < 0.5 and not (low and low.curved)
    bodies, obstacles = [_driven(rng, "top", top, motion, stuff, by_force)], ()
    if rigid:
        obstacles = (_ground(rng),)
        pair = _pair(rng, "contact", "top", top.contact, "ground", (), False)
    else:
        other = stuff if rng.random() < 0.5 else material(rng, stuff[1]["Young modulus"])[1]
        bodies = [Body("low", low.geometry, *other, fixed=low.support),
                  _borne_by(bodies[0], stuff, other)]
        pair = _pair(rng, "contact", "top", top.contact, "low", low.contact)
    return Scene("Two bodies, " + motion.kind, tuple(bodies), obstacles, (pair,),
                 motion.end_time, motion.end_time * rng.randint(2, 4),
                 clearance=_clearance(low, top, bore))


def row(rng, numbers=(2, 2, 3)):
    """Bodies beside each other on a common base, as many as one of @p numbers says."""
    n = rng.choice(numbers)
    h, width = rng.uniform(0.6, 1.2), 1.2 * n
    _, stuff = material(rng)
    base = parts.Box((-width / 2, -0.7, -h), (width / 2, 0.7, 0.0), (3 * n, 3, 2),
                     parts.grading(rng))
    bodies, pairs, end = [Body("base", base, *stuff, fixed=("bottom",))], [], 1
    for i in range(n):
        part = parts.above(rng, 0.45, ((i - (n - 1) / 2) * 1.2, rng.uniform(-0.2, 0.2)))
        strain, own = material(rng, stuff[1]["Young modulus"])
        motion = Motion(rng, KINDS, strain * part.height, 0.1,
                        ((i - (n - 1) / 2) * 1.2, 0.0))
        name = f"body{i + 1}"
        bodies.append(_borne_by(_driven(rng, name, part, motion, own,
                                        part.flat_top and rng.random() < 0.4), own, stuff))
        pairs.append(_pair(rng, f"pair{i + 1}", name, part.contact, "base", ("top",)))
        end = max(end, motion.end_time)
    # Phases that a motion does not have it rests in: formulas of time say so.
    return Scene(f"{n} bodies on one base", tuple(bodies), (), tuple(pairs), end,
                 end * rng.randint(2, 3))


def row_of_four(rng):
    """Four bodies beside each other on a common base."""
    return row(rng, (4,))


def table(rng):
    """A plate on two legs that stand on a base, and keep their place by one of their sides."""
    strain, stuff = material(rng)
    h, low = rng.uniform(0.5, 1.0), rng.uniform(0.3, 0.8)
    base = parts.Box((-1.2, -0.7, -low), (1.2, 0.7, 0.0), (rng.randint(4, 7), 3, 2),
                     parts.grading(rng))
    bodies, legs, area = [Body("base", base, *stuff, fixed=("bottom",))], [], 0.0
    held, pairs = Condition((Formula(0.0), Formula(0.0), None)), []
    for name, side, x in (("left leg", "left", -1.0), ("right leg", "right", 0.4)):
        width = rng.uniform(0.4, 0.6)
        leg = parts.Box((x, -0.3, 0.0), (x + width, 0.3, h), parts.cells(rng, 2, 4),
                        parts.grading(rng))
        legs.append(material(rng, stuff[1]["Young modulus"])[1])
        area += 0.6 * width
        bodies.append(Body(name, leg, *legs[-1], conditions=((side, held),)))
        pairs.append(_pair(rng, f"foot of {name}", name, ("bottom",), "base", ("top",)))
    plate = parts.Box((-1.1, -0.5, h), (1.1, 0.5, h + 0.3), (rng.randint(4, 7), 3, 2))
    strain = min([strain] + [STRAINS[leg[0]["Law"]] for leg in legs])
    motion = Motion(rng, KINDS, strain * (h + 0.3), 0.1)
    top = parts.Part(plate, ("bottom",), ("top",), h + 0.3, 0.5, False, True)
    driven = _driven(rng, "plate", top, motion, material(rng, stuff[1]["Young modulus"])[1],
                     rng.random() < 0.4)
    bodies.append(_borne_by(driven, stuff, *legs, share=area / 2.2))
    for name in ("left leg", "right leg"):
        pairs.append(_pair(rng, f"head of {name}", name, ("top",), "plate", ("bottom",)))
    return Scene("A plate on two legs, " + motion.kind, tuple(bodies), (), tuple(pairs),
                 motion.end_time, motion.end_time * rng.randint(2, 4))


def corner(rng):
    """A box in a corner of planes or of bodies, with an edge that belongs to two pairs."""
    strain, stuff = material(rng)
    size = tuple(rng.uniform(0.6, 1.2) for _ in range(3))
    box = parts.Box((0.0, 0.0, 0.0), size, parts.cells(rng, 2, 4), parts.grading(rng))
    pressure = strain * stuff[1]["Young modulus"]
    if rng.random() < 0.5:
        top = Condition((Formula(0.0), Formula(0.0),
                         Formula(-strain * size[2], "min(1, t)")))
        conditions = (("top", top),)
    else:
        conditions = (("top", Condition((None, Formula(0.0), None),
                                        (None, None, Formula(-pressure, "min(1, t)")))),
                      ("right", Condition(traction=(Formula(-0.3 * pressure, "min(1, t)"),
                                                    None, None))))
    law, coefficient = behaviour(rng)
    walls = (_ground(rng, "floor"),
             Obstacle("wall", "plane", (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), STILL))
    pairs = tuple(Pair(f"{o.name}pair", "box", (side,), o.name, (), settings(rng), law, coefficient)
                  for o, side in zip(walls, ("bottom", "left")))
    end = 1
    return Scene("Corner", (Body("box", box, *stuff, conditions=conditions),), walls, pairs, end,
                 rng.randint(2, 4))


def quarter(rng):
    """A quarter, cut by two symmetry planes."""
    strain, stuff = material(rng)
    r = rng.uniform(0.5, 1.0)
    kind = rng.choice(("ball", "cap", "box"))
    if kind == "ball":
        top = parts.Part(parts.Ball((0.0, 0.0, r), r, (2, 2), ("+", "+", "-")), ("surface",),
                         ("z cut",), r, r, True)
        planes = ("x cut", "y cut")
    elif kind == "cap":
        cap = parts.Cap((0.0, 0.0, 0.0), "sphere", 2.5 * r, "bottom", "quarter", r, r,
                        (3, 2, 2, 2), contact_width=0.3 * r)
        top, planes = parts.Part(cap, ("contact",), ("far",), r, r, True), ("x cut", "y cut")
    else:
        box = parts.Box((0.0, 0.0, 0.0), (r, 0.8 * r, r), parts.cells(rng, 2, 4),
                        parts.grading(rng))
        top, planes = parts.Part(box, ("bottom",), ("top",), r, r, False, True), ("left", "front")
    motion = Motion(rng, ("press", "press", "lift off"), (max(2 * strain, 0.04) if top.curved else strain) * r, 0)
    driven = _driven(rng, "top", top, motion, stuff, top.flat_top and rng.random() < 0.5)
    support = tuple((b, Condition((None, None) + c.displacement[2:], c.traction))
                    for b, c in driven.conditions)
    size = rng.uniform(0.8, 1.5)
    base = parts.Box((0.0, 0.0, -0.8), (size, size, 0.0), parts.cells(rng, 3, 5),
                     parts.grading(rng))
    other = material(rng, stuff[1]["Young modulus"])[1]
    driven = _borne_by(dataclasses.replace(driven, symmetry=planes, conditions=support),
                       stuff, other)
    low = Body("low", base, *other, symmetry=("left", "front", "bottom"))
    pair = _pair(rng, "contact", "top", top.contact, "low", ("top",))
    return Scene("Quarter of a " + kind, (low, driven), (), (pair,), motion.end_time,
                 motion.end_time * rng.randint(2, 4))
