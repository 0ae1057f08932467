# SPDX-License-Identifier: LGPL-2.1-or-later
# ctest: label = quick
"""A block of finite strain that bounces on a plane, in explicit dynamics: a run that resumes has the same bits; a
plane that is free keeps momentum and its moment with the block, with friction and springs, too; velocities that
damping alone changes are those of the exact solution, however large it is."""

import math

from touchstone_test import STEPS, below, check, checks, finish, folder, run, stopped_and_resumed

SCENE = checks / "explicit_bouncing.prm"
LAST = {"Load stepping/End time": 1, "Checkpoints/Steps between": 5}


def bits(result):
    return (folder / result.folder / "statistics").read_text(encoding="utf-8")


for name, settings in (("full", {"Body block/Element": "full"}), ("f_bar", {"Time integration/Step check interval": 1}),
                       ("one_point", {"Body block/Element": "one point"})):
    whole = run(name, SCENE, {**LAST, **settings})
    for ranks in 1, 2:
        resumed = stopped_and_resumed(f"{name}_{ranks}", SCENE, {**LAST, **settings}, 5, ranks)
        check(bits(resumed) == bits(whole), f"{resumed}: other bits on {ranks} rank(s)")

# Block and plane together.
MASS, INERTIA, CENTRE = 2, (3, 4, 5), (0.5, 0.5, -0.5)
FREE = {"Obstacle plane/Free directions": "x, y, z, about x, about y, about z", "Obstacle plane/Mass": MASS,
        "Obstacle plane/Inertia": ", ".join(map(str, INERTIA)), "Obstacle plane/Reference point": ", ".join(map(str, CENTRE)),
        "Obstacle plane/Initial velocity": "0.1, 0.2, 0.3", "Obstacle plane/Initial angular velocity": "0.1, 0.2, -0.2"}


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def turned(v, x):
    """The vector x, turned by the rotation vector v."""
    angle = math.hypot(*v)
    if angle == 0:
        return x
    k = [c / angle for c in v]
    along = sum(a * b for a, b in zip(k, x)) * (1 - math.cos(angle))
    return [a * math.cos(angle) + b * math.sin(angle) + c * along for a, b, c in zip(x, cross(k, x), k)]


def momenta(row):
    """Momentum and its moment about the origin, of block and plane."""
    def vector(name):
        return [row[f"{name} {axis}"] for axis in "xyz"]

    velocity, turn = vector("obstacle plane: velocity"), [math.radians(a) for a in vector("obstacle plane: rotation")]
    place = [a + b for a, b in zip(CENTRE, vector("obstacle plane: displacement"))]
    own = turned([-a for a in turn], vector("obstacle plane: angular velocity"))
    spin = turned(turn, [j * w for j, w in zip(INERTIA, own)])
    moment = cross(place, [MASS * v for v in velocity])
    return ([p + MASS * v for p, v in zip(vector("momentum"), velocity)],
            [a + b + c for a, b, c in zip(vector("angular momentum"), moment, spin)])


for name, settings in (("frictionless", {}), ("friction", {"Contact pair contact/Behaviour": "coulomb",
                                                           "Contact pair contact/Friction/Coefficient": 0.3})):
    for enforcement in "forward increment", "soft penalty":
        free = run(f"free_{name}_{enforcement.replace(' ', '_')}", SCENE,
                   {**FREE, **settings, "Contact/Enforcement": enforcement})
        first, *later = map(momenta, free.rows())
        check(max(row["contact: active nodes"] for row in free.rows()) > 0, f"{free}: no contact")
        for what, k in ("momentum", 0), ("its moment", 1):
            below(f"{free}, {what}", max(math.dist(row[k], first[k]) for row in later), 1e-11)

# A block in free flight that is damped: how far it comes, v (1 - exp(-a t)) / a.
# The last one needs shorter cycles than the cells.
for factor, settings, bound in (10, {}, 3e-4), (10, {"Time integration/Courant factor": 0.1}, 5e-6), (1e3, {}, 3e-3):
    far = run(f"damped_{factor:g}_{len(settings)}", SCENE,
              {**settings, "Body block/Material/Rayleigh mass": factor,
               "Body block/Initial velocity x": 0, "Body block/Initial velocity y": 0, "Body block/Initial velocity z": 1,
               "Probes": "middle", "Probe middle/Body": "block", "Probe middle/Place": "point",
               "Probe middle/Point": "0.7, 0.5, 0.6", "Load stepping/End time": 5 / factor, STEPS: 5})
    for row in far.probe("middle")[1:]:
        way = (1 - math.exp(-factor * row["time"])) / factor
        below(f"{far}, way at t = {row['time']:g}", abs(row["displacement_z"] / way - 1), bound)
finish()
