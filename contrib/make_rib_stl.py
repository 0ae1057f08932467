#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Write the STL surface of the tool of prm/seal.prm: a rib with a half-round edge of radius 3, whose
lowest line is at z = 6, from y = -1 to y = 5. Usage: contrib/make_rib_stl.py prm/meshes/rib.stl"""

import math
import sys

RADIUS, CENTRE, TOP, FRONT, BACK, FACETS = 3.0, 9.0, 12.0, -1.0, 5.0, 40


def unit_normal(corners):
    a, b = ([corner[d] - corners[0][d] for d in range(3)] for corner in corners[1:])
    normal = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    length = math.hypot(*normal)
    return [x / length for x in normal]


def numbers(values):
    return " ".join(f"{0.0 if abs(x) < 1e-12 else x:.6g}" for x in values)


# The outline in the plane y = 0, as points (x, z), and triangles that look outwards.
angles = [math.pi * (i / FACETS - 0.5) for i in range(FACETS + 1)]
outline = [(RADIUS * math.sin(a), CENTRE - RADIUS * math.cos(a)) for a in angles]
outline += [(RADIUS, TOP), (-RADIUS, TOP)]
triangles = []
for (x0, z0), (x1, z1) in zip(outline, outline[1:] + outline[:1]):
    triangles.append(((x0, FRONT, z0), (x1, BACK, z1), (x1, FRONT, z1)))
    triangles.append(((x0, FRONT, z0), (x0, BACK, z0), (x1, BACK, z1)))
    triangles.append(((0, FRONT, CENTRE), (x0, FRONT, z0), (x1, FRONT, z1)))
    triangles.append(((0, BACK, CENTRE), (x1, BACK, z1), (x0, BACK, z0)))
with open(sys.argv[1], "w", encoding="ascii") as file:
    file.write("solid rib\n")
    for triangle in triangles:
        file.write(f"facet normal {numbers(unit_normal(triangle))}\nouter loop\n")
        for vertex in triangle:
            file.write(f"vertex {numbers(vertex)}\n")
        file.write("endloop\nendfacet\n")
    file.write("endsolid rib\n")
