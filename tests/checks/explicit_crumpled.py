# SPDX-License-Identifier: LGPL-2.1-or-later
"""A strip that a piston crumples in a box: general contact with itself and with the walls, and the energy
balance. `crossings` looks for surfaces that cross, and contacts are counted
(doc/general_contact.md, section 7). With more arguments: cells along the strip, travel of the piston,
results, which are few as the tool is slow, and the height of the box."""

import sys
from collections import defaultdict
from itertools import product
from math import dist, floor, sin

from touchstone_test import below, check, contact_gives, finish, folder, rounds_are_few, run
import crossings  # of tests/, which touchstone_test finds
from hexahedra import box

# Beside the arguments of all checks, by hand: CELLS TRAVEL STEPS HEIGHT.
MORE = [word for word in sys.argv[4:] if word.replace(".", "").isdigit()]
CELLS, TRAVEL, STEPS, HEIGHT = map(float, (MORE + ["60", "25", "20", "4"][len(MORE):]))
CELLS, STEPS = int(CELLS), int(STEPS)
LENGTH, THICKNESS, WIDTH, SPEED = CELLS / 2, 0.3, 1, 1
REACH = 0.6  # farther than the nearest node of a face that is touched


def wavy(point):
    """Not quite straight: which way the strip buckles is not left to round-off."""
    x, y, z = point
    return x, y, z + 0.05 * sin(0.7 * x) + 0.04 * sin(1.9 * x + 0.3 * y) + 0.03 * sin(0.31 * x + 1)


WALLS = {"left": ((0, 0, 0), (1, 0, 0)), "right": ((LENGTH, 0, 0), (-1, 0, 0)),
         "bottom": ((0, 0, -HEIGHT / 2), (0, 0, 1)), "top": ((0, 0, HEIGHT / 2), (0, 0, -1)),
         "front": ((0, -1, 0), (0, 1, 0)), "back": ((0, 1, 0), (0, -1, 0))}
box((0.01, -WIDTH / 2, -THICKNESS / 2), (LENGTH - 0.01, WIDTH / 2, THICKNESS / 2), (CELLS, 2, 2)).mapped(
    wavy).written(folder / "strip.vtk")
TEXT = f"""set Bodies = strip
set Obstacles = {", ".join(WALLS)}
set Contact pairs = {", ".join(WALLS)}, itself
subsection Body strip
  set Element = one point
  subsection Geometry
    set Type = file
    set File = strip.vtk
  end
  subsection Material
    set Law = neo-Hookean
    set Young modulus = 1000
    set Poisson ratio = 0.3
    set Density = 1
  end
end
subsection Contact pair itself
  set Slave body = strip
end
subsection Time integration
  set Scheme = central_differences
end
subsection Load stepping
  set End time = {TRAVEL / SPEED}
  set Steps = {STEPS}
end
"""
for name, (point, direction) in WALLS.items():
    motion = f"  set Motion x = -{SPEED}*t\n" if name == "right" else ""
    TEXT += f"""subsection Obstacle {name}
  set Shape = plane
  set Point = {point[0]}, {point[1]}, {point[2]}
  set Direction = {direction[0]}, {direction[1]}, {direction[2]}
{motion}end
subsection Contact pair {name}
  set Slave body = strip
  set Slave boundaries = all
  set Obstacle = {name}
end
"""
(folder / "strip.prm").write_text(TEXT, encoding="utf-8")


def self_contacts(step):
    """Nodes that general contact presses, and in how many places the strip lies on itself. Each node that is
    pressed is a point in the plane of two coordinates along the strip before deformation: its own and that of
    the node that is nearest of another part. Points within 1.1, two cells, belong to one place, so that two
    folds that lie on each other are one."""
    nodes, cells = crossings.read(result.folder / f"solution_{step:04d}.vtu")
    in_cubes = defaultdict(list)
    for name in {corner for corners, _ in crossings.surface(nodes, cells) for corner in corners}:
        in_cubes[tuple(floor(x / REACH) for x in nodes[name])].append(name)

    def other_part(name):
        cube = tuple(floor(x / REACH) for x in nodes[name])
        near = (other for offset in product((-1, 0, 1), repeat=3)
                for other in in_cubes[tuple(c + o for c, o in zip(cube, offset))]
                if abs(other[1][0] - name[1][0]) > 1.2)
        found = min(((dist(nodes[name], nodes[other]), other) for other in near), default=(REACH, name))
        return found[1] if found[0] < REACH else None

    pressed = {(0, tuple(node.position)) for node in result.contact_nodes(step)
               if node.pair == len(WALLS) and node.status > 0}
    points = {tuple(sorted((name[1][0], other[1][0]))) for name in pressed if (other := other_part(name))}
    places = 0
    while points:
        places += 1
        front = [points.pop()]
        while front:
            s, t = front.pop()
            found = {point for point in points if abs(point[0] - s) < 1.1 and abs(point[1] - t) < 1.1}
            points -= found
            front += found
    return len(pressed), places


result = run("strip", folder / "strip.prm", vtu=1)
files = sorted(result.folder.glob("solution_*.vtu"))
for path in files:
    places = crossings.find(path)
    check(not places, f"{len(places)} crossings in {path.name}, the first at {places[:1]}")
contacts = [self_contacts(step) for step in range(len(files))]
print("nodes that meet the strip itself, and places where it does:", contacts)
check(bool(contacts) and max(contacts)[0] > 1.5 * CELLS and max(places for _, places in contacts) > 3,
      "the strip does not meet itself as it should")
below("balance error", abs(result.value("motion", "energies", "balance_error")) /
      result.value("motion", "energies", "external"), 1e-2)
contact_gives(result, 1e-6)
print("cycles between results:", max(result.column("cycles")))
rounds_are_few(result, 1e-3, 7e-3 if CELLS <= 60 else 2e-2)
finish()
