# SPDX-License-Identifier: LGPL-2.1-or-later
"""Write square_tube.prm, a quarter of a square tube of 40 mm and 2 mm that is crushed along its axis, and its
mesh square_tube.msh (Gmsh 2.2).

Usage: python3 contrib/make_square_tube.py FOLDER [ELEMENT]     (F-bar)

The tube is cut in the middle of two sides; its corners have a radius of 3 mm in the middle of the wall."""

import pathlib
import sys
from math import cos, pi, sin

WIDTH, WALL, LENGTH, RADIUS = 40, 2, 60, 3
SIDE, CORNER, THROUGH, ALONG = 9, 4, 2, 60  # cells of half a side, of a corner, of the wall, of the length
AROUND = 2 * SIDE + CORNER


def position(layer, around):
    """Of a node in a cross-section."""
    flat, offset = WIDTH / 2 - RADIUS, WALL * (layer / THROUGH - 0.5)
    if around <= SIDE:
        return WIDTH / 2 + offset, flat * around / SIDE
    if around >= SIDE + CORNER:
        return flat * (AROUND - around) / SIDE, WIDTH / 2 + offset
    angle = pi / 2 * (around - SIDE) / CORNER
    return flat + (RADIUS + offset) * cos(angle), flat + (RADIUS + offset) * sin(angle)


def node(layer, around, height):
    """Its number."""
    return 1 + layer + (THROUGH + 1) * (around + (AROUND + 1) * height)


def face(place, axes):
    """Four nodes from a place along two axes."""
    steps = ((0, 0), (1, 0), (1, 1), (0, 1))
    return [node(*(place[d] + a * (d == axes[0]) + b * (d == axes[1]) for d in range(3))) for a, b in steps]


def lines():
    """The mesh file."""
    places = [(k, j, z) for z in range(ALONG + 1) for j in range(AROUND + 1) for k in range(THROUGH + 1)]
    inside = [p for p in places if p[0] < THROUGH and p[1] < AROUND and p[2] < ALONG]
    elements = [f"5 2 10 10 {' '.join(map(str, face(p, (0, 1)) + face((p[0], p[1], p[2] + 1), (0, 1))))}"
                for p in inside]
    names = {1: "y cut", 2: "x cut", 3: "inner", 4: "outer", 5: "start", 6: "end"}
    ends = {1: (1, 0), 2: (1, AROUND), 3: (0, 0), 4: (0, THROUGH), 5: (2, 0), 6: (2, ALONG)}
    for tag, (axis, at) in ends.items():
        across = [d for d in range(3) if d != axis]
        for p in {tuple(at if d == axis else p[d] for d in range(3)) for p in inside}:
            elements.append(f"3 2 {tag} {tag} {' '.join(map(str, face(p, across)))}")
    yield from ("$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names) + 1))
    yield from (f'2 {tag} "{name}"' for tag, name in names.items())
    yield from ('3 10 "tube"', "$EndPhysicalNames", "$Nodes", str(len(places)))
    for k, j, z in places:
        x, y = position(k, j)
        yield f"{node(k, j, z)} {x:.12g} {y:.12g} {LENGTH * z / ALONG:.12g}"
    yield from ("$EndNodes", "$Elements", str(len(elements)))
    yield from (f"{i + 1} {element}" for i, element in enumerate(elements))
    yield "$EndElements"


folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)
(folder / "square_tube.msh").write_text("\n".join(lines()) + "\n", encoding="ascii")
scene = (pathlib.Path(__file__).parent.parent / "prm/benchmarks/crushed_tube.prm").read_text(encoding="utf-8")
start, end = scene.index("    set Type         = tube"), scene.index("  end\n  subsection Material")
scene = scene[:start] + "    set Type = file\n    set File = square_tube.msh\n" + scene[end:]
scene = scene.replace("first cut, second cut", "x cut, y cut").replace("crushed tube", "crushed square tube")
if len(sys.argv) > 2:
    scene = scene.replace("F-bar", sys.argv[2])
(folder / "square_tube.prm").write_text(scene, encoding="utf-8")
