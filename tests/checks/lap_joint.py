# SPDX-License-Identifier: LGPL-2.1-or-later
"""A bolted lap joint: two plates that a bolt clamps, which nothing but contact and friction holds, pulled until they
slip. The bolt stays in its hole, forces are in balance and on the cone, enforcements and pairings agree."""

from math import cos, hypot, pi, sin

from touchstone_test import (ENFORCEMENT, EXACT_ENFORCEMENTS, STEPS, below, check, checks, finish, folder,
                             relative, run, same)
from hexahedra import Mesh, box, move  # of tests/

HOLE, SHANK, HEAD, THICKNESS, WIDTH, NEAR = 4.4, 4, 8, 3, 10, 1e-6
# Head and nut are too near to each other by twice this: the clamping.
OVERLAP = 0.004


def rectangle(size):
    """Half of the outline of a square from one end of the axis x to the other, as a function of 0 to 1."""
    def at(way):
        x, y = (1, 4 * way) if way < 0.25 else (2 - 4 * way, 1) if way < 0.75 else (-1, 4 - 4 * way)
        return size * x, size * y
    return at


def circle(radius):
    """Half of a circle, beside the points of the square."""
    return lambda way: (radius * cos(pi * way), radius * sin(pi * way))


def between(inner, outer, around, across, layers, height):
    """A half ring between two outlines."""
    def mapped(point):
        part, way, z = point
        return tuple(a + part * (b - a) for a, b in zip(inner(way), outer(way))) + (z,)
    return box((0, 0, 0), (1, 1, height), (across, around, layers)).mapped(mapped)


def plate(side, radial):
    """Half of a plate with its hole, whose long part is on this side of the bolt."""
    mesh = between(circle(HOLE), rectangle(WIDTH), 8, 3 * radial, 1, THICKNESS)
    for end, cells in (45 * side, 4), (-15 * side, 1):
        start = WIDTH if end > 0 else -WIDTH
        mesh = mesh.joined(box((min(start, end), 0, 0), (max(start, end), WIDTH, THICKNESS),
                               (cells, 2, 1)))
    return mesh.oriented()


def bolt(radial):
    """Half of the bolt, from the plane between the plates as far down as up."""
    half = SHANK / 2

    def part(low, high, layers, outer):
        mesh = box((-half, 0, 0), (half, half, high - low), (4, 2, layers))
        mesh = mesh.joined(between(rectangle(half), circle(SHANK), 8, 1, layers, high - low))
        if outer:
            mesh = mesh.joined(between(circle(SHANK), circle(HEAD), 8, 3 * radial, layers, high - low))
        return mesh.mapped(move((0, 0, low)))
    rest = THICKNESS - OVERLAP
    return Mesh().joined(part(-rest, rest, 2, False)).joined(part(rest, 2 * THICKNESS, 1, True)).joined(
        part(-2 * THICKNESS, -rest, 1, True)).oriented()


def at(direction, value):
    """Whether a point has this coordinate."""
    return lambda point: abs(point[direction] - value) < NEAR


def flange(height):
    """Whether a point is on the ring at this height that lies on a plate."""
    return lambda point: abs(point[2] - height) < NEAR and hypot(*point[:2]) > SHANK - NEAR


def meshes(radial):
    """Write the mesh files; returns the settings that take them."""
    files = {}
    for body, mesh, boundaries in (
            ("lower", plate(-1, radial).mapped(move((0, 0, -THICKNESS))),
             {"cut": at(1, 0), "bottom": at(2, -THICKNESS), "top": at(2, 0), "left": at(0, -45)}),
            ("upper", plate(1, radial),
             {"cut": at(1, 0), "bottom": at(2, 0), "top": at(2, THICKNESS), "right": at(0, 45)}),
            ("bolt", bolt(radial), {"cut": at(1, 0), "under_head": flange(THICKNESS - OVERLAP),
                                  "under_nut": flange(OVERLAP - THICKNESS)})):
        path = folder / f"{body}_{radial}.vtk"
        mesh.written(path, boundaries)
        files[f"Body {body}/Geometry/File"] = path
    return files


def joint(name, files, settings, pairing, slopes):
    """A run; the bolt is where it must be, and the last state is in balance and on the cone, but for the slopes of the
    bent plates, which change directions of forces by this part."""
    settings = {**files, **{f"Contact pair {pair}/Pairing": pairing for pair in ("plates", "head", "nut")},
                **settings}
    result = run(f"{name}_{pairing}", checks / "lap_joint.prm", settings)
    if not result.summary:
        return result
    # The end of the upper plate goes to the right, the lower one is held: in the end the bolt is in between.
    last = result.probe("bolt")[-1]
    end = 0.1 * (last["time"] - 0.5)
    check(0.1 * end < last["displacement_x"] < 0.9 * end and
          all(abs(row[f"displacement_{axis}"]) < OVERLAP for row in result.probe("bolt") for axis in "yz"),
          f"{result}: the end of the upper plate moves by {end:g}, the bolt by {last}")
    pull, head, plates = result.reaction("upper", "right")[0], result.force("head"), result.force("plates")
    below(f"{result}, head and plates carry the pull", relative(head[0] + plates[0], pull), 1e-8)
    below(f"{result}, nut pulls as the head", relative(-result.force("nut")[2], head[2]), 1e-8)
    for pair in "head", "nut", "plates":
        check(result.column(f"{pair}: stick nodes")[-1] == 0, f"{result}: nodes of {pair} stick")
    below(f"{result}, the pull {pull} on the cone", relative(pull, 0.3 * (head[2] - plates[2])), slopes)
    return result


# Three cells over the flange of the bolt: each pairing has one answer, whatever the enforcement.
coarse = meshes(1)
shorter = {"Load stepping/End time": 1, STEPS: 4}
for pairing in "averaged", "pointwise":
    answers = [joint(enforcement, coarse, {**shorter, ENFORCEMENT: enforcement}, pairing, 3e-3)
               for enforcement in EXACT_ENFORCEMENTS]
    for other in answers[1:]:
        same(answers[0], other, 1e-6)
    penalty = joint("penalty", coarse, {**shorter, ENFORCEMENT: "penalty"}, pairing, 3e-3)
    for pair in "head", "plates":
        below(f"{penalty}, {pair}", relative(penalty.force(pair)[2], answers[0].force(pair)[2]), 0.01)

# A step in which nothing moves lies between clamp and pull. The direction in which open nodes came was that of its
# round-off, and enforcements were 1.2e-5 of the pull apart.
less = {f"Contact pair {pair}/Friction/Coefficient": 0.29 for pair in ("plates", "head", "nut")}
rested = [run(f"rested_{enforcement}", checks / "lap_joint.prm", {**coarse, **shorter, **less, ENFORCEMENT: enforcement})
          for enforcement in ("elimination", "augmented lagrange")]
same(*rested, 1e-6)

# Nine: pairings agree on clamp and pull, which on three are a third apart.
fine = meshes(3)
results = [joint("nine_cells", fine, {}, pairing, 2e-4) for pairing in ("averaged", "pointwise")]
clamps = [result.rows()[0]["head: force z"] for result in results]
pulls = [result.reaction("upper", "right")[0] for result in results]
below(f"pairings differ in the clamp, {clamps}", relative(*clamps), 0.005)
below(f"pairings differ in the pull, {pulls}", relative(*pulls), 0.03)
finish()
