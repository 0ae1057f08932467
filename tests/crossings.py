# SPDX-License-Identifier: LGPL-2.1-or-later
"""Finds surfaces that cross each other in VTU files of bodies, by brute force and apart from what
the program does: edges against triangles, signs of volumes in rational numbers where they are small."""

import pathlib
import re
from collections import defaultdict
from fractions import Fraction
from math import floor, inf, sqrt

from fuzzing.vtu import unpack  # pylint: disable=import-error

# The corners of the faces of a hexahedron, outward.
FACES = (0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)
FORMS = {"Float32": "f", "Float64": "d", "Int32": "i", "UInt8": "B"}


def minus(a, b):
    """Difference."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def cross(a, b):
    """Vector product."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot(a, b):
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def side(a, b, c, d):
    """Sign of the volume of a tetrahedron."""
    u, v, w = minus(b, a), minus(c, a), minus(d, a)
    volume = dot(cross(u, v), w)
    if abs(volume) < 1e-12 * sqrt(dot(u, u) * dot(v, v) * dot(w, w)):
        a, b, c, d = (tuple(map(Fraction, point)) for point in (a, b, c, d))
        volume = dot(cross(minus(b, a), minus(c, a)), minus(d, a))
    return (volume > 0) - (volume < 0)


def passes(p, q, triangle):
    """Whether a segment passes through the inside of a triangle."""
    a, b, c = triangle
    if side(a, b, c, p) * side(a, b, c, q) >= 0:
        return False
    signs = side(p, q, a, b), side(p, q, b, c), side(p, q, c, a)
    return signs in ((1, 1, 1), (-1, -1, -1))


def read(path):
    """Positions of nodes by (body, place before deformation), and the cells with these names."""
    nodes, cells = {}, []
    text = pathlib.Path(path).read_text(encoding="utf-8", errors="replace")
    for piece in re.findall(r"<Piece (.*?)</Piece>", text, re.S):
        arrays = {}
        for form, attributes, data in re.findall(
                r'<DataArray type="(\w+)"([^>]*)>\s*(.*?)\s*</DataArray>', piece, re.S):
            name = re.search(r'Name="([^"]*)"', attributes)
            if (name[1] if name else "position") in ("position", "displacement", "body", "connectivity"):
                arrays[name[1] if name else "position"] = unpack(data, FORMS[form])
        at, u, body = arrays["position"], arrays["displacement"], arrays["body"]
        names = [(int(body[i]), at[3 * i:3 * i + 3]) for i in range(len(body))]
        for i, name in enumerate(names):
            nodes[name] = tuple(x + d for x, d in zip(name[1], u[3 * i:3 * i + 3]))
        corners = arrays["connectivity"]
        cells += [tuple(names[c] for c in corners[i:i + 8]) for i in range(0, len(corners), 8)]
    return nodes, cells


def check_planes(path, mirrored):
    """A file of VTK does not say where planes of symmetry are, and faces on them would pass for surfaces."""
    scene = pathlib.Path(path).with_name("parameters.prm")
    text = scene.read_text(encoding="utf-8") if scene.exists() else ""
    if not mirrored and re.search(r"^ *set Symmetry *= *[^ #\n]", text, re.M):
        raise ValueError(f"{scene}: bodies have planes of symmetry: name them in 'mirrored'")


def reflected(nodes, cells, axis, place):
    """Bodies and their mirror images beyond the plane where coordinate @p axis is @p place: faces on the plane
    are inside then, and normals beside it are those of the whole."""
    near = 1e-9 * max(abs(x) for _, at in nodes for x in at)

    def image(point):
        return tuple(2 * place - x if d == axis else x for d, x in enumerate(point))

    def name(node):
        # Places of nodes on the plane are exact, so that both sides have the same.
        body, at = node
        return body, tuple(place if d == axis and abs(x - place) < near else x for d, x in enumerate(at))
    named = {name(node): x for node, x in nodes.items()}
    images = {(node[0], image(node[1])): image(x) for node, x in named.items()}
    turned = (1, 0, 3, 2, 5, 4, 7, 6)
    both = [tuple(map(name, cell)) for cell in cells]
    return {**images, **named}, both + [tuple((cell[i][0], image(cell[i][1])) for i in turned) for cell in both]


def surface(nodes, cells):
    """Faces that belong to one cell, as (corners, cell)."""
    found = defaultdict(list)
    for cell in cells:
        for face in FACES:
            corners = tuple(cell[i] for i in face)
            found[frozenset(corners)].append((corners, cell))
    return [faces[0] for faces in found.values() if len(faces) == 1]


def moved_inwards(nodes, faces, part, as_promised=False):
    """Positions of the nodes of surfaces, moved inwards by a part of the size of their faces: the root of
    the mean area of those around the node before deformation, as the program promises, but no more
    than twice the root of twice the smallest of them as it is."""
    normals, areas, smallest = defaultdict(lambda: (0, 0, 0)), defaultdict(list), {}
    for corners, _ in faces:
        x, placed = [nodes[c] for c in corners], [c[1] for c in corners]
        area = cross(minus(x[2], x[0]), minus(x[3], x[1]))
        before = cross(minus(placed[2], placed[0]), minus(placed[3], placed[1]))
        for corner in corners:
            normals[corner] = tuple(n + a for n, a in zip(normals[corner], area))
            areas[corner].append(0.5 * sqrt(dot(before, before)))
            smallest[corner] = min(0.5 * sqrt(dot(area, area)), smallest.get(corner, inf))
    result = {}
    for corner, normal in normals.items():
        length = sqrt(dot(normal, normal)) or 1
        size = sqrt(sum(areas[corner]) / len(areas[corner]))
        if not as_promised:
            size = min(size, 2 * sqrt(2 * smallest[corner]))
        result[corner] = tuple(x - part * size * n / length for x, n in zip(nodes[corner], normal))
    return result


def find(path, inset=1.5e-4, as_promised=False, mirrored=()):
    """Places where an edge of a surface passes through a face. At the tips of slender bodies the program
    promises less than what is looked at, unless @p as_promised.
    @param mirrored: planes of symmetry, (axis, coordinate): what is looked at is the whole."""
    check_planes(path, mirrored)
    nodes, cells = read(path)
    for axis, place in mirrored:
        nodes, cells = reflected(nodes, cells, axis, place)
    faces = surface(nodes, cells)
    at = moved_inwards(nodes, faces, inset, as_promised)
    triangles, edges, lengths = [], {}, []
    for corners, cell in faces:
        x = [at[c] for c in corners]
        middle = tuple(sum(p[d] for p in x) / 4 for d in range(3))
        for i in range(4):
            j = (i + 1) % 4
            triangles.append(((x[i], x[j], middle), frozenset(cell)))
            edges[frozenset((corners[i], corners[j]))] = x[i], x[j]
            lengths.append(sqrt(dot(minus(x[i], x[j]), minus(x[i], x[j]))))
    size = sorted(lengths)[len(lengths) // 2]

    def buckets(points):
        low = [floor(min(p[d] for p in points) / size) for d in range(3)]
        high = [floor(max(p[d] for p in points) / size) for d in range(3)]
        return [(x, y, z) for x in range(low[0], high[0] + 1) for y in range(low[1], high[1] + 1)
                for z in range(low[2], high[2] + 1)]

    grid = defaultdict(list)
    for number, (triangle, _) in enumerate(triangles):
        for bucket in buckets(triangle):
            grid[bucket].append(number)
    places = []
    for ends, (p, q) in edges.items():
        for number in {number for bucket in buckets((p, q)) for number in grid[bucket]}:
            triangle, cell = triangles[number]
            if any(max(p[d], q[d]) < min(x[d] for x in triangle) or
                   min(p[d], q[d]) > max(x[d] for x in triangle) for d in range(3)):
                continue
            if not ends & cell and passes(p, q, triangle):
                places.append(tuple(0.5 * (a + b) for a, b in zip(p, q)))
                break
    return places
