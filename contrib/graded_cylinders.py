#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mesh of two equal cylinders along y, a slice of one cell, whose cells follow the edges of stick
and contact: narrowest at the given distances from the middle, growing away from them.

Usage: contrib/graded_cylinders.py FILE.msh EDGES SIZE LARGEST GROWTH [key=value]...
  EDGES    distances of the edges, ascending: 0.68,0.972
  SIZE     of the cells there, and thickness of the layer at the contact
  LARGEST  size within the last edge
  GROWTH   factor from one cell to the next
Keys: radius (100), width and height (20), depth (0.25), outer (growth beyond the last edge and,
away from the contact, twice its distance; 1.4), layer (growth away from the contact before, 1.4).

Bodies are the volumes upper and lower of a file of Gmsh 2.2; boundaries are NAME_contact, NAME_far,
NAME_side, NAME_cut and NAME_end (the ends of the slice).
"""

import math
import pathlib
import sys


def growing(length, first, growth, largest, beyond=(math.inf, 1.0)):
    """Distances from 0 to length, first intervals of the size first; beyond a distance they grow
    by another factor."""
    result, size = [0.0], first
    while result[-1] < (1 - 1e-10) * length:
        result.append(result[-1] + size)
        size = min((growth if result[-1] < beyond[0] else beyond[1]) * size, largest)
    return [x * length / result[-1] for x in result]


def between(a, b, first, growth, largest):
    """Points from a to b, small at both."""
    half = growing((b - a) / 2, first, growth, largest)
    return [a + x for x in half] + [b - x for x in reversed(half[:-1])]


def half_width(edges, size, largest, growth, options):
    """Points from the middle to the side."""
    points = [edges[0] - x for x in reversed(growing(edges[0], size, growth, largest))]
    for a, b in zip(edges, edges[1:]):
        points += between(a, b, size, growth, largest)[1:]
    rest = growing(options["width"] - edges[-1], size, options["outer"], math.inf)
    return points + [edges[-1] + x for x in rest[1:]]


def sag(x, radius):
    return x * x / (radius + math.sqrt(radius * radius - x * x))


def write(path, xs, layers, options):
    """Both bodies: the lower one is the upper one turned about y."""
    depth, height = options["depth"], options["height"]
    nodes, cells, faces = [], [], []
    nx, nz = len(xs), len(layers)
    names = [(f"{body}_{part}", 2) for body in ("upper", "lower")
             for part in ("contact", "far", "side", "cut", "end")] + [("upper", 3), ("lower", 3)]
    for body, sign in enumerate((1, -1)):
        def at(i, j, k, start=len(nodes)):
            return start + 1 + i + nx * (j + 2 * k)

        for z in layers:
            for y in (0.0, depth):
                # From the arc at the contact to the flat far face.
                nodes += [(sign * x, y, sign * (z + sag(x, options["radius"]) * (1 - z / height)))
                          for x in xs]
        for i in range(nx - 1):
            for k in range(nz - 1):
                cell = [at(i, 0, k), at(i + 1, 0, k), at(i + 1, 1, k), at(i, 1, k),
                        at(i, 0, k + 1), at(i + 1, 0, k + 1), at(i + 1, 1, k + 1), at(i, 1, k + 1)]
                cells.append((11 + body, cell))
                faces += [(5 * body + 4, cell[:2] + cell[5:3:-1]),
                          (5 * body + 5, [cell[3], cell[2], cell[6], cell[7]])]
                if k == 0:
                    faces.append((5 * body + 1, cell[:4]))
                if k == nz - 2:
                    faces.append((5 * body + 2, cell[4:]))
                if i == 0:
                    faces.append((5 * body + 3, [cell[0], cell[3], cell[7], cell[4]]))
                if i == nx - 2:
                    faces.append((5 * body + 3, [cell[1], cell[2], cell[6], cell[5]]))
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names))]
    lines += [f'{dim} {number + 1} "{name}"' for number, (name, dim) in enumerate(names)]
    lines += ["$EndPhysicalNames", "$Nodes", str(len(nodes))]
    lines += [f"{n + 1} {x:.16g} {y:.16g} {z:.16g}" for n, (x, y, z) in enumerate(nodes)]
    lines += ["$EndNodes", "$Elements", str(len(faces) + len(cells))]
    for number, (kind, (tag, corners)) in enumerate([(3, f) for f in faces] +
                                                    [(5, c) for c in cells]):
        lines.append(f"{number + 1} {kind} 2 {tag} {tag} " + " ".join(map(str, corners)))
    path.write_text("\n".join(lines + ["$EndElements", ""]), encoding="ascii")


def main():
    if len(sys.argv) < 6:
        sys.exit(__doc__)
    options = {"radius": 100.0, "width": 20.0, "height": 20.0, "depth": 0.25, "outer": 1.4,
               "layer": 1.4}
    for word in sys.argv[6:]:
        key, _, value = word.partition("=")
        if key not in options:
            sys.exit(f"graded_cylinders: there is no key '{key}'. There are {', '.join(options)}.")
        options[key] = float(value)
    edges = [float(x) for x in sys.argv[2].split(",")]
    size, largest, growth = map(float, sys.argv[3:6])
    right = half_width(edges, size, largest, growth, options)
    xs = [-x for x in reversed(right[1:])] + right
    layers = growing(options["height"], size, options["layer"], math.inf,
                     (2 * edges[-1], options["outer"]))
    write(pathlib.Path(sys.argv[1]), xs, layers, options)


if __name__ == "__main__":
    main()
