# SPDX-License-Identifier: LGPL-2.1-or-later
"""A strip that a piston crumples in a box: general contact with itself and with the walls, and the energy
balance. `crossings` looks for surfaces that cross, and contacts are counted by a search of its own
(doc/general_contact.md, section 7). With two more arguments: cells along the strip, and travel of the piston."""

import sys
from collections import defaultdict
from math import sin, sqrt

from touchstone_test import below, check, contact_gives, finish, folder, run
import crossings  # of tests/, which touchstone_test finds
from hexahedra import box

MORE = sys.argv[4:]
CELLS, TRAVEL = (int(MORE[0]), float(MORE[1])) if len(MORE) == 2 else (60, 25)
LENGTH, HEIGHT, THICKNESS, WIDTH, SPEED, STEPS = CELLS / 2, 4, 0.3, 1, 1, 20


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


def distance(point, start, end):
    """Of a point from a segment."""
    along, there = crossings.minus(end, start), crossings.minus(point, start)
    part = min(1, max(0, crossings.dot(along, there) / crossings.dot(along, along)))
    away = tuple(a - part * b for a, b in zip(there, along))
    return sqrt(crossings.dot(away, away))


def self_contacts(path):
    """How many times the strip meets itself: groups of pairs of its cross-sections whose middles are no
    farther from each other than 1.1 times its thickness."""
    sections = defaultdict(list)
    for (_, place), position in crossings.read(path)[0].items():
        sections[round(place[0], 6)].append(position)
    line = [tuple(sum(x[d] for x in sections[name]) / len(sections[name]) for d in range(3))
            for name in sorted(sections)]
    near = {(i, j) for i in range(len(line)) for j in range(len(line) - 1)
            if abs(i - j) > 4 and distance(line[i], line[j], line[j + 1]) < 1.1 * THICKNESS}
    near |= {(j, i) for i, j in near}
    count = 0
    while near:
        count += 1
        open_pairs = [near.pop()]
        while open_pairs:
            i, j = open_pairs.pop()
            for other in [(i + a, j + b) for a in (-1, 0, 1) for b in (-1, 0, 1)]:
                if other in near:
                    near.remove(other)
                    open_pairs.append(other)
    return count // 2


result = run("strip", folder / "strip.prm", vtu=1)
files = sorted(result.folder.glob("solution_*.vtu"))
for path in files:
    places = crossings.find(path)
    check(not places, f"{len(places)} crossings in {path.name}, the first at {places[:1]}")
contacts = self_contacts(files[-1]) if files else 0
print(f"{contacts} self-contacts")
check(contacts >= 20 * CELLS // 100, "the strip meets itself less often than it should")
below("balance error", abs(result.value("motion", "energies", "balance_error")) /
      result.value("motion", "energies", "external"), 1e-2)
contact_gives(result, 1e-6)
rounds = result.summary.get("general_contact", {})
print(f"checks {rounds.get('checks_of_crossings')}, cycles with more than five {rounds.get('cycles_with_more_than_five')}, "
      f"halvings {rounds.get('halvings')}")
finish()
