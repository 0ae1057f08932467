# SPDX-License-Identifier: LGPL-2.1-or-later
"""What must hold within one run, whatever the scene.

Each function looks at a scene and the result of its run and yields findings. Bounds are for
round-off of what the program prints and of Newton's tolerances; none is a matter of mesh or
step size.
"""

import dataclasses
import re

from . import runs
from .geometry import norm


@dataclasses.dataclass(frozen=True)
class Finding:
    """Something that must not be; 'kind' groups them in the table."""
    kind: str
    text: str


# Relative to the largest force of a run; the table of statistics has nine digits.
BALANCE = 1e-6
# The same where springs hold bodies without friction, of which a warning tells.
HELD_BY_SPRINGS = 2e-4
# Relative to the size of the scene; pictures have single precision.
PENETRATION = 1e-6
# Relative to the largest pressure, in pictures.
PRESSURE = 1e-4
# Relative to the size of the scene, slip that has no direction.
ROUND_OFF = 1e-10
# Relative to Young's modulus: a fiftieth of the pressure of gaps that are within their tolerance of 1e-8.
NO_PRESSURE = 2e-10


def largest_force(scene, result):
    """The largest pair force or reaction or load of the run."""
    sizes = [norm(result.force(row, p.name)) for row in result.rows for p in scene.pairs]
    sizes += [norm(result.reaction(row, b.name)) for row in result.rows for b in scene.bodies]
    sizes += [norm(scene.load(b, row["time"])) for row in result.rows for b in scene.bodies]
    # Forces around a shaft balance each other; what they hold is pressure, and perhaps a moment.
    sizes += [row[f"{p.name}: max pressure"] * row[f"{p.name}: area"]
              for row in result.rows for p in scene.pairs]
    # In steps without any force, as where bodies that touch move together, there remains what
    # iterative solvers leave of displacements: some 1e-14 of the stiffness, which must be less than
    # BALANCE of this.
    return max(sizes + [1e-7 * scene.stiffness()])


def messages(_scene, result):
    """No text of a library, no signal, a reason for each exit code."""
    raw = runs.RAW.search(result.terminal)
    if result.timed_out:
        return
    if result.exit_code < 0 or result.exit_code > 3:
        yield Finding("crash", f"exit code {result.exit_code}: {result.reason()}")
    elif raw:
        yield Finding("raw message", f"'{raw[0]}': {result.reason()}")
    elif result.exit_code and not result.reason():
        yield Finding("no message", f"exit code {result.exit_code}")


def balance(scene, result):
    """Contact forces, loads and reactions of each body add up to zero."""
    size = largest_force(scene, result)
    bound = HELD_BY_SPRINGS if "springs hold it" in result.terminal else BALANCE
    for row in result.rows:
        for body in scene.bodies:
            total = [a + b for a, b in zip(result.reaction(row, body.name),
                                           scene.load(body, row["time"]))]
            for pair in scene.pairs:
                sign = (pair.slave == body.name) - (pair.master == body.name)
                total = [a + sign * f for a, f in zip(total, result.force(row, pair.name))]
            if norm(total) > bound * size:
                yield Finding("balance", f"body {body.name} at t = {row['time']:g}: forces left "
                              f"over {norm(total) / size:.1e} of the largest")
                return


def finite(_scene, result):
    for row in result.rows:
        for name, value in row.items():
            if not abs(value) < 1e300:
                yield Finding("not a number", f"{name} = {value} at t = {row['time']:g}")
                return


def adjusted(pair):
    """Whether gaps count from where the bodies are placed."""
    return ("Initial overlap", "adjust") in pair.settings


def overlap(scene, result):
    """The start report of the first pair says what is true of the shapes as they are placed."""
    said = re.search(r"smallest gap (\S+?)(:|\n)", result.terminal)
    if scene.clearance is None or said is None or \
            ("Contact geometry", "faceted") in scene.pairs[0].settings:
        return
    gap = float(said[1])
    facets = sum(b.geometry.sagitta() for b in scene.bodies) + PENETRATION * scene.size()
    if gap < scene.clearance - facets:
        yield Finding("false overlap", f"gap {gap:g} where the shapes have {scene.clearance:g} and "
                      f"facets stray from them by {facets:.3g}")
    if scene.clearance < -PENETRATION * scene.size() and gap > 0:
        yield Finding("overlap not seen", f"gap {gap:g} where the shapes have {scene.clearance:g}")
    if scene.clearance > facets and scene.title.endswith("rest"):
        force = max(norm(result.force(row, scene.pairs[0].name)) for row in result.rows)
        if force > 1e-10 * scene.stiffness():
            yield Finding("false overlap", f"force {force:g} where the shapes do not touch")


def penetration(scene, result):
    """As the program reports it, in each step and at each node in the end."""
    bound = PENETRATION * scene.size()
    for row in result.rows:
        for pair in scene.pairs:
            deep = row[f"{pair.name}: max penetration"]
            if deep > bound:
                yield Finding("penetration", f"{pair.name} at t = {row['time']:g}: "
                              f"{deep / scene.size():.1e} of the size")
                return


def obstacles(scene, result):
    """No slave node is inside of its obstacle, from its position alone."""
    shapes = {o.name: o for o in scene.obstacles}
    for node in result.nodes:
        obstacle = shapes.get(scene.pairs[node.pair].master)
        if obstacle is None or adjusted(scene.pairs[node.pair]) or result.rows[-1]["time"] < scene.end_time * (1 - 1e-9):
            continue
        moved = [p + (f.at(scene.end_time) if f else 0.0)
                 for p, f in zip(obstacle.point, obstacle.motion)]
        way = [x - p for x, p in zip(node.deformed(), moved)]
        size = norm(obstacle.direction)
        along = sum(w * d / size for w, d in zip(way, obstacle.direction))
        if obstacle.shape == "plane":
            gap = along
        else:
            if obstacle.shape == "cylinder":
                way = [w - along * d / size for w, d in zip(way, obstacle.direction)]
            gap = norm(way) - obstacle.radius
            gap = -gap if obstacle.side == "inside" else gap
        if gap < -1e-5 * scene.size():
            yield Finding("penetration", f"{scene.pairs[node.pair].name}: a node is "
                          f"{-gap / scene.size():.1e} of the size inside of the obstacle, "
                          f"status {node.status}")
            return


def tractions(scene, result):
    """No tension; shear within what the law allows and against the slip."""
    if not result.nodes:
        return
    largest = max(abs(n.pressure) for n in result.nodes)
    # Bodies that only touch press each other with what the tolerance of gaps leaves.
    none = NO_PRESSURE * scene.stiffness() / scene.size() ** 2
    for node in result.nodes:
        pair = scene.pairs[node.pair]
        bound = PRESSURE * max(abs(n.pressure) for n in result.nodes if n.pair == node.pair)
        bound = max(bound, 1e-6 * largest, none)
        shear, p = node.shear(), node.normal_traction()
        limit = {"frictionless": 0.0, "coulomb": pair.coefficient * max(p, 0.0),
                 "tresca": pair.coefficient if node.status > 0 else 0.0}[pair.behaviour]
        if min(p, node.pressure) < -bound:
            yield Finding("tension", f"{pair.name}: {min(p, node.pressure) / largest:.1e} of the "
                          f"largest pressure, status {node.status}")
            return
        if norm(shear) > limit * (1 + PRESSURE) + bound:
            yield Finding("cone", f"{pair.name}: shear {norm(shear):.4g} where {limit:.4g} is "
                          f"allowed, largest pressure {largest:.4g}, status {node.status}")
            return


def against_slip(scene, result):
    """Friction of nodes that slip is opposed to their slip."""
    longest = max((norm(n.slip) for n in result.nodes), default=0.0)
    for node in result.nodes:
        pair = scene.pairs[node.pair]
        shear, slip = node.shear(), node.slip
        size = norm(shear) * norm(slip)
        if pair.behaviour == "frictionless" or node.status != 1 or size == 0 or \
                norm(slip) < max(1e-3 * longest, ROUND_OFF * scene.size()) or \
                norm(shear) < 1e-2 * abs(node.normal_traction()):
            continue
        cosine = sum(a * b for a, b in zip(shear, slip)) / size
        if cosine > 0.02:
            yield Finding("with the slip", f"{pair.name}: cosine of shear and slip {cosine:.2f}, "
                          f"slip {norm(slip) / longest:.1e} of the longest")
            return


def friction_work(_scene, result):
    """Work against friction never decreases."""
    values = [0.0] + [row["energy: friction"] for row in result.rows if "energy: friction" in row]
    strain = max((row["energy: strain"] for row in result.rows), default=0.0)
    largest = max(max(values), strain)
    for before, after in zip(values, values[1:]):
        if after < before - 1e-6 * largest:
            yield Finding("friction gives energy", f"{before:.6g}, then {after:.6g}")
            return


ALWAYS = (messages, )
CONVERGED = (finite, balance, overlap, penetration, obstacles, tractions, against_slip, friction_work)


def judge(scene, result):
    """All findings of a run."""
    checks = ALWAYS + (CONVERGED if result.converged() else ())
    return [finding for check in checks for finding in check(scene, result)]
