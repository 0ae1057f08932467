# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies of hexahedra for checks, as scene sections with mesh files."""

from itertools import product
from math import cos, pi, sin, sqrt


def turn(axis, angle):
    """Rotation about an axis through the origin, as a function of points."""
    size = sqrt(sum(a * a for a in axis))
    x, y, z = (a / size for a in axis)
    c, s, d = cos(angle), sin(angle), 1 - cos(angle)
    rows = ((c + x * x * d, x * y * d - z * s, x * z * d + y * s),
            (y * x * d + z * s, c + y * y * d, y * z * d - x * s),
            (z * x * d - y * s, z * y * d + x * s, c + z * z * d))
    return lambda point: tuple(sum(m * p for m, p in zip(row, point)) for row in rows)


def move(by):
    """Translation, as a function of points."""
    return lambda point: tuple(p + b for p, b in zip(point, by))


class Mesh:
    """Points and hexahedra in the order of VTK."""

    def __init__(self, points=(), cells=()):
        self.points, self.cells = list(points), list(cells)

    def mapped(self, *maps):
        """The mesh with all maps applied, one after the other."""
        points = self.points
        for one in maps:
            points = [one(point) for point in points]
        return Mesh(points, self.cells)

    def joined(self, other, tolerance=1e-9):
        """Both meshes, with points at the same place as one."""
        numbers, points = {}, []

        def number(point):
            key = tuple(round(p / tolerance) for p in point)
            if key not in numbers:
                numbers[key] = len(points)
                points.append(point)
            return numbers[key]
        cells = [tuple(number(mesh.points[i]) for i in cell)
                 for mesh in (self, other) for cell in mesh.cells]
        return Mesh(points, cells)

    def oriented(self):
        """The mesh with cells of positive volume."""
        cells = []
        for cell in self.cells:
            a, b, c, d = (self.points[cell[i]] for i in (0, 1, 3, 4))
            u, v, w = ([p - q for p, q in zip(x, a)] for x in (b, c, d))
            volume = (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
                      u[2] * (v[0] * w[1] - v[1] * w[0]))
            cells.append(cell if volume > 0 else cell[4:] + cell[:4])
        return Mesh(self.points, cells)

    def without(self, removed):
        """The mesh without the cells whose middle is where @p removed says."""
        cells = [cell for cell in self.cells
                 if not removed(tuple(sum(self.points[i][d] for i in cell) / 8 for d in range(3)))]
        return Mesh(self.points, cells).joined(Mesh())

    def written(self, path, boundaries=None):
        """Write a VTK file.

        @param boundaries: which points are on each of the boundaries with these names, as functions of points
        ('Boundary arrays' of the scene).
        """
        lines = ["# vtk DataFile Version 3.0", "hexahedra", "ASCII", "DATASET UNSTRUCTURED_GRID",
                 f"POINTS {len(self.points)} double"]
        lines += [" ".join(f"{p:.17g}" for p in point) for point in self.points]
        lines += [f"CELLS {len(self.cells)} {9 * len(self.cells)}"]
        lines += ["8 " + " ".join(map(str, cell)) for cell in self.cells]
        lines += [f"CELL_TYPES {len(self.cells)}"] + ["12"] * len(self.cells)
        if boundaries:
            lines += [f"POINT_DATA {len(self.points)}"]
        for name, holds in (boundaries or {}).items():
            lines += [f"SCALARS {name} int", "LOOKUP_TABLE default"]
            lines += [str(int(holds(point))) for point in self.points]
        path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def box(lower, upper, cells):
    """A box."""
    sides = [range(n + 1) for n in cells]
    points = [tuple(a + (b - a) * i / n for a, b, i, n in zip(lower, upper, (x, y, z), cells))
              for z, y, x in product(*reversed(sides))]

    def node(x, y, z):
        return x + (cells[0] + 1) * (y + (cells[1] + 1) * z)
    corners = [(a, b, c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
    return Mesh(points, [tuple(node(x + a, y + b, z + c) for a, b, c in corners)
                         for z, y, x in product(*(range(n) for n in reversed(cells)))])


def ball(radius, cells):
    """A ball: a cube whose shells become spheres towards the surface."""
    def rounded(point):
        largest = max(map(abs, point))
        if largest == 0:
            return point
        # Tangents spread the corners of faces evenly.
        even = [largest * sin(pi / 4 * p / largest) / cos(pi / 4 * p / largest) for p in point]
        size = sqrt(sum(e * e for e in even))
        part = 0.5 + 0.5 * largest
        return tuple(radius * ((1 - part) * p / sqrt(3) + part * e * largest / size)
                     for p, e in zip(point, even))
    return box((-1, -1, -1), (1, 1, 1), (cells,) * 3).mapped(rounded)


def bowl(inner, outer, cells, layers):
    """A hollow ball with an opening on top: five sides of a cube that is made round."""
    mesh = Mesh()
    maps = [lambda p: (p[0], p[1], -p[2]), lambda p: (p[2], p[0], p[1]), lambda p: (-p[2], -p[0], p[1]),
            lambda p: (p[1], p[2], p[0]), lambda p: (p[1], -p[2], p[0])]
    for way in maps:
        sheet = box((-1, -1, 0), (1, 1, 1), (cells, cells, layers))

        def curved(point, way=way):
            x, y, depth = point
            direction = way((sin(pi / 4 * x) / cos(pi / 4 * x), sin(pi / 4 * y) / cos(pi / 4 * y), 1))
            size = sqrt(sum(d * d for d in direction))
            radius = inner + (outer - inner) * depth
            return tuple(radius * d / size for d in direction)
        mesh = mesh.joined(sheet.mapped(curved))
    return mesh.oriented()


def ring(radius, thickness, width, around, across, along, span=2 * pi):
    """A ring about the axis y, closed if its span is a full turn.

    @param around, across, along: cells around it, through its thickness and over its width.
    """
    strip = box((0, 0, 0), (1, 1, 1), (around, along, across))

    def bent(point):
        angle, r = -span * point[0], radius + thickness * (point[2] - 0.5)
        return (r * cos(angle), width * (point[1] - 0.5), r * sin(angle))
    return Mesh().joined(strip.mapped(bent)).oriented()


def write_gmsh(path, cells, place, boundary):
    """Write a Gmsh file of hexahedra whose corners have any names: points at the same place with different names
    are different nodes.

    @param cells: the names of the corners of each, in the order of Gmsh.
    @param place: the point of a name.
    @param boundary: the name of the boundary of a face at the surface, given the names of its corners.
    """
    sides = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (2, 3, 7, 6), (1, 2, 6, 5), (0, 4, 7, 3))
    numbers = {corner: n + 1 for n, corner in enumerate(dict.fromkeys(corner for cell in cells for corner in cell))}
    faces = {}
    for cell in cells:
        for side in sides:
            face = tuple(cell[a] for a in side)
            faces.setdefault(frozenset(face), []).append(face)
    outer = [found[0] for found in faces.values() if len(found) == 1]
    names = sorted({boundary(face) for face in outer})
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", len(names)]
    lines += [f'2 {n + 1} "{found}"' for n, found in enumerate(names)]
    lines += ["$EndPhysicalNames", "$Nodes", len(numbers)]
    lines += [" ".join(map(repr, (n, *place(corner)))) for corner, n in numbers.items()]
    lines += ["$EndNodes", "$Elements", len(outer) + len(cells)]
    elements = [(3, names.index(boundary(face)) + 1, face) for face in outer] + [(5, 100, cell) for cell in cells]
    lines += [f"{n + 1} {kind} 2 {tag} {tag} {' '.join(str(numbers[corner]) for corner in corners)}"
              for n, (kind, tag, corners) in enumerate(elements)]
    path.write_text("\n".join(map(str, [*lines, "$EndElements", ""])), encoding="utf-8")


def corners_of(i, j, k):
    """The corners of a cell of a lattice, in the order of Gmsh."""
    return [(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
