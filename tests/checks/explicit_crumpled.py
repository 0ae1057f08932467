# SPDX-License-Identifier: LGPL-2.1-or-later
"""A strip that a piston crumples in a box: general contact with itself and with the walls, and the energy
balance. `crossings` looks for surfaces that cross, and contacts are counted
(doc/general_contact.md, section 7). With more arguments: cells along the strip, travel of the piston,
results, which are few as the tool is slow, and the height of the box."""

import sys
from collections import defaultdict
from math import sin

from touchstone_test import below, check, contact_gives, finish, folder, rounds_are_few, run
import crossings  # of tests/, which touchstone_test finds
from hexahedra import box

# Beside the arguments of all checks, by hand: CELLS TRAVEL STEPS HEIGHT.
MORE = [word for word in sys.argv[4:] if word.replace(".", "").isdigit()]
CELLS, TRAVEL, STEPS, HEIGHT = map(float, (MORE + ["60", "25", "20", "4"][len(MORE):]))
CELLS, STEPS = int(CELLS), int(STEPS)
LENGTH, THICKNESS, WIDTH, SPEED = CELLS / 2, 0.3, 1, 1


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


def patches(step):
    """Nodes that general contact presses, and connected groups of them on the surface: a fold that
    touches another has one on each."""
    nodes, cells = crossings.read(result.folder / f"solution_{step:04d}.vtu")
    near = defaultdict(set)
    for corners, _ in crossings.surface(nodes, cells):
        for corner in corners:
            near[tuple(corner[1])].update(tuple(other[1]) for other in corners)
    pressed = {tuple(node.position) for node in result.contact_nodes(step)
               if node.pair == len(WALLS) and node.status > 0}
    n_pressed, groups = len(pressed), 0
    while pressed:
        groups += 1
        front = [pressed.pop()]
        while front:
            found = near[front.pop()] & pressed
            pressed -= found
            front += found
    return n_pressed, groups


result = run("strip", folder / "strip.prm", vtu=1)
files = sorted(result.folder.glob("solution_*.vtu"))
for path in files:
    places = crossings.find(path)
    check(not places, f"{len(places)} crossings in {path.name}, the first at {places[:1]}")
contacts = [patches(step) for step in range(len(files))]
print("nodes that meet the strip itself, and groups of them:", contacts)
check(bool(contacts) and max(contacts)[0] > 1.5 * CELLS, "the strip does not meet itself as it should")
below("balance error", abs(result.value("motion", "energies", "balance_error")) /
      result.value("motion", "energies", "external"), 1e-2)
contact_gives(result, 1e-6)
print("cycles between results:", max(result.column("cycles")))
rounds_are_few(result, 1e-3, 7e-3 if CELLS <= 60 else 2e-2)
finish()
