#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Write prm/meshes/press_fit_quarter.msh: two quarter tubes for a press fit.

Gmsh format 2.2, with named physical volumes "inner tube" and "outer tube" and
named physical surfaces inner_bore, inner_skin, inner_start, inner_end,
inner_cut_x (the plane x = 0), inner_cut_y (the plane y = 0), and the same for
outer. The tubes share no nodes.

Usage: make_press_fit_mesh.py FILE
"""

import math
import sys

RADIAL, ANGULAR, AXIAL = 4, 12, 1
THICKNESS = 0.25
TUBES = [("inner", 0.5, 1.001), ("outer", 1.0, 1.5)]
SIDES = ["bore", "skin", "cut_y", "cut_x", "start", "end"]


def tube_nodes(inner, outer):
    """Nodes in the order radial, angular, axial, radial fastest."""
    for k in range(AXIAL + 1):
        for j in range(ANGULAR + 1):
            angle = math.pi / 2 * j / ANGULAR
            # Exactly on the symmetry planes, where rounding would leave 1e-17.
            cosine = 0.0 if j == ANGULAR else math.cos(angle)
            for i in range(RADIAL + 1):
                r = inner + (outer - inner) * i / RADIAL
                yield r * cosine, r * math.sin(angle), THICKNESS * k / AXIAL


def main(file_name):
    nodes, elements, names = [], [], []
    for number, (tube, inner, outer) in enumerate(TUBES):
        first = len(nodes) + 1
        nodes.extend(tube_nodes(inner, outer))

        def node(i, j, k):
            return first + i + (RADIAL + 1) * (j + (ANGULAR + 1) * k)

        volume = number + 1
        names.append((3, volume, tube + " tube"))
        for k in range(AXIAL):
            for j in range(ANGULAR):
                for i in range(RADIAL):
                    ring = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                    corners = [node(a, b, k + c) for c in (0, 1) for a, b in ring]
                    elements.append((5, volume, corners))

        count = [RADIAL, ANGULAR, AXIAL]
        for side, name in enumerate(SIDES):
            surface = 10 * volume + side
            names.append((2, surface, tube + "_" + name))
            d = side // 2
            a, b = (d + 1) % 3, (d + 2) % 3
            for q in range(count[b]):
                for p in range(count[a]):
                    corners = []
                    for e, f in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        index = [0, 0, 0]
                        index[d] = count[d] * (side % 2)
                        index[a], index[b] = p + e, q + f
                        corners.append(node(*index))
                    elements.append((3, surface, corners))

    with open(file_name, "w", encoding="ascii") as out:
        out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n")
        out.write(f"$PhysicalNames\n{len(names)}\n")
        for dimension, number, name in names:
            out.write(f'{dimension} {number} "{name}"\n')
        out.write(f"$EndPhysicalNames\n$Nodes\n{len(nodes)}\n")
        for number, x in enumerate(nodes, 1):
            out.write(f"{number} {x[0]:.16g} {x[1]:.16g} {x[2]:.16g}\n")
        out.write(f"$EndNodes\n$Elements\n{len(elements)}\n")
        for number, (kind, group, corners) in enumerate(elements, 1):
            joined = " ".join(map(str, corners))
            out.write(f"{number} {kind} 2 {group} {group} {joined}\n")
        out.write("$EndElements\n")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
