# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes of general contact in which surfaces meet in every way that is hard, in the manner of the
tests of intersection-free contact of computer graphics: spikes, wedges, holes, cracks, cliffs, inner
edges, a chain, folds, slender faces, a bullet. A tool that knows nothing of the program looks for
crossings, and scenes that are turned give the results turned (doc/general_contact.md, section 7)."""

import random
from math import pi

from touchstone_test import below, check, checks, contact_gives, finish, folder, run
import crossings  # of tests/, which touchstone_test finds
from hexahedra import ball, bowl, box, move, ring, turn

UP, DOWN, FALL = (0, 0, .5), (0, 0, -.5), (0, 0, -1)
ABOUT_Z, ON_CORNER, ON_EDGE = (0, 0, 1), turn((1, -1, 0), 0.9553166), turn((0, 1, 0), pi / 4)
TURNED = turn((.3, -.7, .5), 1.234)
# Bodies that balance on each other's tips turn with the scene only as long as no round-off tells
# left from right; rows of parallel edges say the same to 1e-7, which sweeps do not resolve.
UNSTABLE = "spike_spike_exact", "sheet_spike", "wedge_wedge_parallel", "edge_edge_parallel"
SCENES, MOST_CYCLES = {}, 100


def scaled(*by):
    """Scaling, as a function of points."""
    return lambda point: tuple(f * p for f, p in zip(by, point))


def flipped(point):
    """Upside down."""
    return point[0], -point[1], -point[2]


def tapered(*axes):
    """A block of height 1 that is narrow at the top along some axes."""
    def narrow(point):
        part = 1 - 0.97 * point[2]
        return tuple(p * part if d in axes else p for d, p in enumerate(point))
    return narrow


def scene(name, *parts, end=1, courant=0.95, balance=1e-2, steps=5):
    """A scene of (mesh, velocity, material and element), its largest relative balance error, and so many
    results that none is more than #MOST_CYCLES after the one before."""
    SCENES[name] = parts, end, courant, balance, steps


def written(name, scene_name, turned=None):
    """Write the scene."""
    parts, end, courant, _, steps = SCENES[scene_name]
    text = [f"set Bodies = {', '.join(f'b{i}' for i in range(len(parts)))}", "set Contact pairs = all"]
    for i, (mesh, velocity, *more) in enumerate(parts):
        settings = {"young": 1000, "density": 1, "element": "one point", **(more[0] if more else {})}
        if turned:
            mesh, velocity = mesh.mapped(turned), turned(velocity)
        mesh.written(folder / f"{name}_{i}.vtk")
        text += [f"subsection Body b{i}", f"  set Element = {settings['element']}"]
        text += [f"  set Initial velocity {axis} = {v:.17g}" for axis, v in zip("xyz", velocity)]
        text += ["  subsection Geometry", "    set Type = file", f"    set File = {name}_{i}.vtk", "  end",
                 "  subsection Material", "    set Law = neo-Hookean",
                 f"    set Young modulus = {settings['young']}", "    set Poisson ratio = 0.3",
                 f"    set Density = {settings['density']}", "  end", "end"]
    text += ["subsection Time integration", "  set Scheme = central_differences",
             f"  set Courant factor = {courant}", "end",
             "subsection Load stepping", f"  set End time = {end}", f"  set Steps = {steps}", "end", ""]
    (folder / f"{name}.prm").write_text("\n".join(text), encoding="utf-8")
    return folder / f"{name}.prm"


CELL, CUBE = (box((-.5, -.5, -.5), (.5, .5, .5), (n, n, n)) for n in (1, 2))
BAR = box((-.5, -2, -.5), (.5, 2, .5), (1, 3, 1)).mapped(ON_EDGE)
PLATE = box((-1.5, -1.5, -.5), (1.5, 1.5, 0), (5, 5, 1))
SPIKE = box((-.5, -.5, 0), (.5, .5, 1), (2, 2, 3)).mapped(tapered(0, 1))
WEDGE = box((-.5, -.5, 0), (.5, .5, 1), (2, 2, 3)).mapped(tapered(0))
SHEET = box((-1, -1, 1.03), (1, 1, 1.08), (6, 6, 1))
HOLE = box((-1.5, -1.5, -1), (1.5, 1.5, 0), (3, 3, 2)).without(
    lambda x: abs(x[0]) < .5 and abs(x[1]) < .5)
CRACK = box((-1.5, -1.5, -1.5), (1.5, 1.5, 0), (3, 3, 3)).without(
    lambda x: abs(x[0]) < .5 and x[2] > -1).mapped(
        lambda x: ((.02 * x[0] if abs(x[0]) <= .5 else x[0] - (.49 if x[0] > 0 else -.49)), x[1], x[2]))
NOTCH = box((-1.5, -1, -.6), (1.5, 1, 0), (6, 4, 1)).mapped(lambda x: (x[0], x[1], x[2] + abs(x[0])))
SLENDER = box((-2.5, -.5, -.1), (2.5, .5, 0), (1, 10, 1))
LINK = ring(1, .3, .3, 16, 1, 1)
FULL = {"element": "full"}  # tips that are crushed fold one-point cells over


def folded():
    """A sheet that is folded over: both halves touch from the start."""
    lower, fold = box((0, 0, -.2), (1, 1, 0), (4, 4, 1)), box((-.2, 0, -.2), (0, 1, .2), (1, 4, 2))
    apart = 1e-7
    upper = box((0, 0, 0), (1, 1, .2), (4, 4, 1)).mapped(
        lambda x: (x[0], x[1], apart if x[0] > 1e-9 and x[2] < 1e-9 else x[2]))
    return lower.joined(fold).joined(upper).mapped(
        lambda x: (x[0], x[1], 0. if 0 < x[2] < 10 * apart else x[2]))


scene("cubes_45", (CELL, UP), (CELL.mapped(turn(ABOUT_Z, pi / 4), move((0, 0, 1.01))), DOWN))
scene("bars", (BAR, UP), (BAR.mapped(turn(ABOUT_Z, pi / 2), move((.13, .07, 1.45))), DOWN))
scene("bars_exact", (BAR, UP), (BAR.mapped(turn(ABOUT_Z, pi / 2), move((0, 0, 1.45))), DOWN))
scene("corner_face", (PLATE, (0, 0, 0)), (CUBE.mapped(ON_CORNER, move((.1, .2, .9))), FALL))
scene("edge_face", (PLATE, (0, 0, 0)), (CUBE.mapped(ON_EDGE, turn(ABOUT_Z, .3), move((.1, .2, .75))), FALL))
scene("corner_corner", (CUBE.mapped(ON_CORNER), UP),
      (CUBE.mapped(ON_CORNER, turn(ABOUT_Z, .4), move((.01, .02, 1.76))), DOWN))
scene("edge_edge", (CUBE.mapped(ON_EDGE), UP),
      (CUBE.mapped(ON_EDGE, turn(ABOUT_Z, .2), move((.02, .01, 1.43))), DOWN))
scene("edge_edge_parallel", (CUBE.mapped(ON_EDGE), UP), (CUBE.mapped(ON_EDGE, move((.02, .01, 1.43))), DOWN))
scene("cliff", (PLATE, (0, 0, 0)), (CUBE.mapped(move((1.55, 0, .52))), FALL))
scene("spike_face", (PLATE, (0, 0, 0)), (SPIKE.mapped(flipped, move((.1, .2, 1.03))), FALL))
scene("spike_spike", (SPIKE, UP, FULL), (SPIKE.mapped(flipped, move((.005, .003, 2.03))), DOWN, FULL),
      courant=.2, steps=32)
scene("spike_spike_exact", (SPIKE, UP, FULL), (SPIKE.mapped(flipped, move((0, 0, 2.03))), DOWN, FULL),
      steps=8)
scene("wedge_wedge", (WEDGE, UP), (WEDGE.mapped(flipped, turn(ABOUT_Z, pi / 2), move((0, 0, 2.03))), DOWN), steps=7)
scene("wedge_wedge_parallel", (WEDGE, UP), (WEDGE.mapped(flipped, move((.005, 0, 2.03))), DOWN), steps=7)
scene("wedge_spike", (WEDGE, UP), (SPIKE.mapped(flipped, move((.005, .1, 2.03))), DOWN), steps=7)
scene("spike_hole", (HOLE, (0, 0, 0)), (SPIKE.mapped(flipped, scaled(1.2, 1.2, 1), move((.02, .01, 1.2))), FALL),
      end=2, steps=10)
scene("cube_hole", (HOLE, (0, 0, 0)), (CUBE.mapped(scaled(.98, .98, 1), turn((1, .3, 0), .05), move((0, 0, .6))), FALL))
scene("wedge_crack", (CRACK, (0, 0, 0)), (WEDGE.mapped(flipped, move((.001, .1, 1.02))), FALL), steps=22)
scene("spike_crack", (CRACK, (0, 0, 0)), (SPIKE.mapped(flipped, move((.001, .1, 1.02))), FALL, FULL), steps=22)
scene("ball_hole", (bowl(1, 1.3, 4, 1), (0, 0, 0)), (ball(.97, 4), (.3, .2, -1)))
scene("ball_notch", (NOTCH, (0, 0, 0)), (ball(.5, 4).mapped(move((.05, 0, .85))), FALL))
scene("slender", (SLENDER, (0, 0, 0)), (SLENDER.mapped(turn(ABOUT_Z, pi / 2), move((0, 0, .12))), FALL),
      (CELL.mapped(scaled(.3, .3, .3), turn((1, 1, 0), .5), move((.1, .05, .4))), FALL))
scene("sizes", (box((-2, -2, -2), (2, 2, 0), (1, 1, 1)), (0, 0, 0)),
      (box((-.5, -.5, .01), (.5, .5, .5), (5, 5, 2)), FALL))
# 19 thicknesses of the plate in a cycle.
scene("bullet", (box((-1, -1, -.01), (1, 1, 0), (4, 4, 1)), (0, 0, 0), {"young": 1}),
      (CELL.mapped(turn((1, .3, 0), .4), move((.1, .05, 1))), (0, 0, -30), {"young": 14.4, "density": 1e-3}),
      end=.2, balance=.05)
scene("thin_wall", (box((-2, -2, -.02), (2, 2, 0), (8, 8, 1)), (0, 0, 0)),
      (ball(.5, 3).mapped(move((.1, .05, .53))), (0, 0, -2)), steps=24)
scene("fold_at_rest", (folded(), (0, 0, 0)))
scene("fold", (folded(), (0, 0, 0)),
      (CELL.mapped(scaled(.5, .5, .5), turn(ABOUT_Z, .3), move((.5, .5, .5))), FALL))
scene("chain", (LINK, (-.5, 0, 0)), (LINK.mapped(turn((1, 0, 0), pi / 2), move((1.5, 0, 0))), (0, 0, 0)),
      (LINK.mapped(move((3, 0, 0))), (.5, 0, 0)), end=2)
scene("sheet_spike", (SPIKE, UP), (SHEET, DOWN), steps=10)
scene("sheet_edge", (WEDGE, UP), (SHEET.mapped(turn(ABOUT_Z, .35)), DOWN), steps=10)
scene("masses", (CUBE, (0, 0, 0), {"density": 1e-3, "young": 1}),
      (CUBE.mapped(turn(ABOUT_Z, .7), move((0, 0, 1.02))), FALL))
scene("stack", *((CELL.mapped(turn(ABOUT_Z, .5 * i), move((0, 0, 1.002 * i))), (0, 0, .5 - .25 * i)) for i in range(5)))
CHANCE = random.Random(5)
scene("heap", *((CELL.mapped(scaled(.4, .4, .4),
                             turn(tuple(CHANCE.random() - .5 for _ in range(3)), 3 * CHANCE.random()),
                             move((.8 * x + .1 * CHANCE.random(), .8 * y + .1 * CHANCE.random(), .8 * z))),
                 (.4 - .8 * x, .4 - .8 * y, .4 - .8 * z)) for x in (0, 1) for y in (0, 1) for z in (0, 1)), end=2)
scene("inner_edges", *((box((i, 0, 0), (i + 1, 1, 1), (2, 2, 2)), (0, 0, 0)) for i in range(20)),
      (box((.4, .1, 1), (1.3, .9, 1.6), (2, 2, 2)), (9, 0, 0)), end=2)

# The tool sees what passes through: without contact, there is something to find.
free = run("no_contact", written("no_contact", "bars"), {"Contact pairs": ""}, vtu=1)
check(sum(len(crossings.find(path)) for path in free.folder.glob("solution_*.vtu")) > 0,
      "bars without contact: no crossing found")

for name, (_, _, _, allowed, steps) in SCENES.items():
    result = run(name, written(name, name), vtu=1)
    files = sorted(result.folder.glob("solution_*.vtu"))
    check(len(files) >= steps, f"{name}: {len(files)} results written")
    below(f"{name}, cycles between results", max(result.column("cycles")), MOST_CYCLES)
    for path in files if name != "inner_edges" else ():
        places = crossings.find(path)
        check(not places, f"{name}: {len(places)} crossings in {path.name}, the first at {places[:1]}")
    if name == "spike_spike_exact":  # 679 if nodes that pressed are not remembered
        below(f"{name}, looks at crossings", result.value("general_contact", "checks_of_crossings"), 300)
    motion = result.summary.get("motion", {})
    energies, velocities = motion.get("energies", {}), motion.get("velocities", {})
    initial = energies.get("initial", 0)
    if initial > 1e-12:
        below(f"{name}, balance error", abs(energies["balance_error"]) / initial, allowed)
        contact_gives(result, 1e-6)
        for axis in "xyz":
            values = result.column(f"momentum {axis}")
            below(f"{name}, momentum {axis}", max(abs(v - values[0]) for v in values), 1e-10)
    else:
        below(f"{name}, force at rest", max((abs(c) for v in velocities.values() for c in v), default=1), 1e-14)
    if name == "inner_edges":
        for body, velocity in velocities.items():
            below(f"{name}, {body}, velocity across", abs(velocity[2]), 1e-10)
        continue
    if name in UNSTABLE:
        continue
    other = run(f"{name}_turned", written(f"{name}_turned", name, TURNED))
    ways = other.summary.get("motion", {}).get("velocities", {})
    check(bool(velocities) and set(ways) == set(velocities), f"{name}: no velocities")
    below(f"{name}, turned", max((abs(a - b) for body in velocities if body in ways
                                  for a, b in zip(TURNED(velocities[body]), ways[body])), default=1), 1e-8)

# Normals that turn from one cycle to the next, also where each cycle is an interval of its own.
for steps in 4, 240:
    result = run(f"turning_{steps}", checks / "explicit_turning.prm", {"Load stepping/Steps": steps}, vtu=steps // 4)
    files = sorted(result.folder.glob("solution_*.vtu"))
    check(len(files) == 5, f"{result}: {len(files)} results written")
    for path in files:
        check(not crossings.find(path), f"{result}: edges have passed through each other in {path.name}")
check(max(result.column("cycles")) == 1, "turning: more than one cycle in an interval")

# A cycle that is halved takes back what forces have done to an obstacle that they move: one apart from all else.
WEIGHT = {"Contact pairs": "everything, weight", "Contact pair everything/Slave body": "all", "Obstacles": "weight",
          "Contact pair weight/Slave body": "b0", "Contact pair weight/Slave boundaries": "all",
          "Contact pair weight/Obstacle": "weight", "Obstacle weight/Shape": "plane",
          "Obstacle weight/Point": "0, 0, -50", "Obstacle weight/Direction": "0, 0, 1",
          "Obstacle weight/Free directions": "z", "Obstacle weight/Mass": 1, "Obstacle weight/Force z": 1}
result = run("weight", folder / "edge_edge.prm", WEIGHT)
check(result.value("general_contact", "halvings") > 0, "weight: no cycle is halved")
below("weight, way", abs(result.column("obstacle weight: displacement z")[-1] - .5), 1e-12)

# Tips that meet edges and inner edges of several faces: each row is on one rank.
SOONER = {"Load stepping/End time": .25, "Load stepping/Steps": 8}
ranks = [run(f"ranks_{n}", folder / "spike_spike.prm", SOONER, n).summary.get("motion") for n in (1, 2)]
check(ranks[0] and ranks[0] == ranks[1], "spike_spike: one and two ranks differ")
finish()
