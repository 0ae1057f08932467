# SPDX-License-Identifier: LGPL-2.1-or-later
"""Faces of contact surfaces: areas of their nodes, and shape functions of quadratic ones."""

import math

# Nodes of a biquadratic face in lexicographic order: corners, then the middles of the
# edges between them, in the order of a face with 8 nodes. The node in the middle, 4, is
# not one of a face of C3D20.
EIGHT = (0, 2, 8, 6, 1, 5, 7, 3)
# Value of the 8 shape functions in the middle of the face.
MIDDLE = (-0.25,) * 4 + (0.5,) * 4

GAUSS = [(x, w) for x, w in ((-math.sqrt(0.6), 5 / 9), (0.0, 8 / 9), (math.sqrt(0.6), 5 / 9))]
CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, 1))


def lagrange(degree, x):
    """Values and derivatives of the Lagrange polynomials on [-1, 1]."""
    if degree == 1:
        return [(1 - x) / 2, (1 + x) / 2], [-0.5, 0.5]
    return [x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2], [x - 0.5, -2 * x, x + 0.5]


def tensor_shapes(degree, x, y):
    """Values and both derivatives of the shape functions of a face, lexicographic."""
    vx, dx = lagrange(degree, x)
    vy, dy = lagrange(degree, y)
    pairs = [(i, j) for j in range(degree + 1) for i in range(degree + 1)]
    return ([vx[i] * vy[j] for i, j in pairs], [dx[i] * vy[j] for i, j in pairs],
            [vx[i] * dy[j] for i, j in pairs])


def serendipity(x, y):
    """Values of the shape functions of a face with 8 nodes."""
    corners = [(1 + x * a) * (1 + y * b) * (x * a + y * b - 1) / 4 for a, b in CORNERS]
    return corners + [(1 - x * x) * (1 - y) / 2, (1 + x) * (1 - y * y) / 2,
                      (1 - x * x) * (1 + y) / 2, (1 - x) * (1 - y * y) / 2]


def face_points(face, nodes, degree):
    """Quadrature points of a face: coordinates x, y, shape functions, normal times weight."""
    for x, wx in GAUSS:
        for y, wy in GAUSS:
            value, by_x, by_y = tensor_shapes(degree, x, y)
            t = [[sum(d * nodes[n][k] for d, n in zip(by, face)) for k in range(3)]
                 for by in (by_x, by_y)]
            yield x, y, value, [wx * wy * (t[0][(k + 1) % 3] * t[1][(k + 2) % 3] -
                                           t[0][(k + 2) % 3] * t[1][(k + 1) % 3])
                                for k in range(3)]


def vector_area(faces, nodes, degree):
    """The integral of the outward normal: a uniform unit pressure has this force."""
    total = [0.0] * 3
    for face in faces:
        for *_, normal in face_points(face, nodes, degree):
            total = [a + b for a, b in zip(total, normal)]
    return total


def node_areas(faces, nodes, degree, quadratic_of_eight=False):
    """Tributary areas: the integral of each node's shape function, as the program does.

    With @p quadratic_of_eight the faces are those of C3D20, whose integrals at corners
    are negative: there each node gets the share that the square of its shape function has.
    """
    areas = {}
    for face in faces:
        own = [0.0] * (8 if quadratic_of_eight else len(face))
        total = 0.0
        for x, y, value, normal in face_points(face, nodes, degree):
            jxw = math.sqrt(sum(c * c for c in normal))
            total += jxw
            weights = [s * s for s in serendipity(x, y)] if quadratic_of_eight else value
            own = [a + w * jxw for a, w in zip(own, weights)]
        scale = total / sum(own)
        members = [face[i] for i in EIGHT] if quadratic_of_eight else face
        for node, area in zip(members, own):
            areas[node] = areas.get(node, 0.0) + scale * area
    return areas
