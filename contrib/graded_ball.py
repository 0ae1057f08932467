# SPDX-License-Identifier: LGPL-2.1-or-later
"""A quarter of a ball, x and y not less than at the centre, with a mesh that is fine at one pole: a
Gmsh file (version 2.2) with the boundaries surface, x cut and y cut."""

import math


def geometric(first, length, cells):
    """Positions from 0 to the length of so many cells that grow by a constant factor."""
    low, high = 1.0, 100.0
    for _ in range(200):
        factor = 0.5 * (low + high)
        if first * (factor ** cells - 1) / (factor - 1) < length:
            low = factor
        else:
            high = factor
    positions = [first * (factor ** i - 1) / (factor - 1) for i in range(cells + 1)]
    return [x * length / positions[-1] for x in positions]


class GradedBall:
    """Core, a box whose half width is half the radius, and shells between its sides and the surface.
    Cells at the pole have the size @p finest."""

    def __init__(self, radius, finest, cells, heights, layers):
        angle = [x / radius for x in geometric(finest, radius * math.pi / 4, cells)]
        self.across = [math.tan(a) for a in angle]            # 0 to 1: box x, y over its half width
        self.along = [-1 + 2 * i / heights for i in range(heights + 1)]
        self.radius, self.half = radius, 0.5 * radius / math.sqrt(1.5)
        # From the surface inwards, as a part of the way to the core.
        depth = radius - self.half
        self.layers = [1 - x / depth for x in reversed(geometric(finest, depth, layers))]
        self.nodes, self.points, self.hexahedra, self.quads = {}, [], [], []
        self.make()

    def node(self, box, layer):
        """Number of the node outside a point of the box, on a layer (0: the box itself)."""
        on_side = max(abs(box[0]), abs(box[1]), abs(box[2]))
        size = math.sqrt(sum(b * b for b in box))
        part = self.layers[layer]
        if layer and on_side < 1 - 1e-12:
            raise ValueError("layers begin at the sides")
        point = tuple((1 - part) * self.half * b + (part * self.radius * b / size if part else 0)
                      for b in box)
        key = tuple(round(p * 1e7) for p in point)
        if key not in self.nodes:
            self.nodes[key] = len(self.points) + 1
            self.points.append(point)
        return self.nodes[key]

    def side(self, first, second, place):
        """Shells outside a side with the box coordinates place(first[i], second[j])."""
        for i in range(len(first) - 1):
            for j in range(len(second) - 1):
                corners = [place(first[a], second[b])
                           for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))]
                for layer in range(len(self.layers) - 1):
                    self.add([self.node(c, layer) for c in corners] +
                             [self.node(c, layer + 1) for c in corners])
                self.quads.append((1, [self.node(c, len(self.layers) - 1) for c in corners]))

    def add(self, nodes):
        """A cell, turned so that its volume is positive; its faces in the planes of the cuts."""
        a, b, c, d = (self.points[nodes[i] - 1] for i in (0, 1, 3, 4))
        edges = [[q - p for p, q in zip(a, other)] for other in (b, c, d)]
        volume = sum(edges[0][i] * (edges[1][(i + 1) % 3] * edges[2][(i + 2) % 3] -
                                    edges[1][(i + 2) % 3] * edges[2][(i + 1) % 3])
                     for i in range(3))
        if volume < 0:
            nodes = nodes[4:] + nodes[:4]
        self.hexahedra.append(nodes)
        for face in ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)):
            for axis in 0, 1:
                if all(abs(self.points[nodes[f] - 1][axis]) < 1e-9 for f in face):
                    self.quads.append((2 + axis, [nodes[f] for f in face]))

    def make(self):
        """All cells."""
        x, z = self.across, self.along
        for i in range(len(x) - 1):
            for j in range(len(x) - 1):
                for k in range(len(z) - 1):
                    self.add([self.node((x[i + a], x[j + b], z[k + c]), 0)
                              for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))])
        self.side(x, x, lambda a, b: (a, b, -1))
        self.side(x, x, lambda a, b: (a, b, 1))
        self.side(x, z, lambda a, b: (1, a, b))
        self.side(x, z, lambda a, b: (a, 1, b))

    def write(self, path, centre, up=1):
        """The file; with up = -1 the fine pole is at the top."""
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "4",
                 '2 1 "surface"', '2 2 "x cut"', '2 3 "y cut"', '3 4 "ball"', "$EndPhysicalNames",
                 "$Nodes", str(len(self.points))]
        for number, point in enumerate(self.points, 1):
            lines.append(f"{number} " + " ".join(
                repr(c + p) for c, p in zip(centre, (point[0], point[1], up * point[2]))))
        lines += ["$EndNodes", "$Elements", str(len(self.quads) + len(self.hexahedra))]
        for number, (tag, quad) in enumerate(self.quads, 1):
            lines.append(f"{number} 3 2 {tag} {tag} " + " ".join(map(str, quad)))
        for number, nodes in enumerate(self.hexahedra, len(self.quads) + 1):
            if up < 0:
                nodes = nodes[4:] + nodes[:4]
            lines.append(f"{number} 5 2 4 4 " + " ".join(map(str, nodes)))
        path.write_text("\n".join([*lines, "$EndElements", ""]), encoding="utf-8")
