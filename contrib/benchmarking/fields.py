# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tractions as the fields that they are: interpolated over slave faces, compared with exact
ones by integrals, as source/verification/contact_field.cc does for this program."""

import functools
import math

from . import surfaces

# Points of each direction: the three of Gauss in four parts of a face, since the edge of the
# contact may cross it.
PARTS = 4
POINTS = [((2 * k + 1 + x) / PARTS - 1, w / PARTS) for k in range(PARTS)
          for x, w in surfaces.GAUSS]
CORNERS = {1: (0, 1, 2, 3), 2: (0, 2, 6, 8)}


@functools.cache
def _rule(degree, kind):
    """Shape functions of a face and of the field at all points, with weights."""
    result = []
    for x, wx in POINTS:
        for y, wy in POINTS:
            shapes = surfaces.tensor_shapes(degree, x, y)
            field = (surfaces.serendipity(x, y) if kind == "eight" else
                     surfaces.tensor_shapes(1, x, y)[0] if kind == "corners" else shapes[0])
            result.append((wx * wy, shapes, field))
    return result


class Field:
    """Nodal values on the faces of a surface.

    @param faces  Nodes in lexicographic order.
    @param values By node; others are zero.
    @param kind   "all" nodes of a face, its "corners", or the "eight" of C3D20.
    """

    def __init__(self, faces, nodes, degree, values, kind="all"):
        self.faces, self.nodes, self.degree, self.kind = faces, nodes, degree, kind
        self.values = values

    def members(self, face):
        """The nodes of a face that have values."""
        if self.kind == "eight":
            return [face[i] for i in surfaces.EIGHT]
        return [face[i] for i in CORNERS[self.degree]] if self.kind == "corners" else face

    def points(self):
        """All points: position, area, shape functions, nodes with values."""
        for face in self.faces:
            places, members = [self.nodes[n] for n in face], self.members(face)
            for weight, (value, by_x, by_y), shapes in _rule(self.degree, self.kind):
                x, s, t = ([sum(v * p[d] for v, p in zip(row, places)) for d in range(3)]
                           for row in (value, by_x, by_y))
                normal = [s[(d + 1) % 3] * t[(d + 2) % 3] - s[(d + 2) % 3] * t[(d + 1) % 3]
                          for d in range(3)]
                yield x, weight * math.sqrt(sum(c * c for c in normal)), shapes, members

    def relative_error(self, exact):
        """Root of int |error|^2 over int |exact|^2, no unit. @param exact At a position."""
        error = size = 0.0
        for x, area, shapes, members in self.points():
            e = exact(x)
            value = sum(s * self.values.get(n, 0.0) for s, n in zip(shapes, members))
            error += area * (value - e) ** 2
            size += area * e * e
        return math.sqrt(error / size) if size > 0 else math.nan

    def recovered(self):
        """The field whose means around the nodes, int N t / int N, are the nodal values, to
        first order: what nodal forces over areas are (doc/theory.md, section 10)."""
        means, areas = {}, {}
        for _, area, shapes, members in self.points():
            value = sum(s * self.values.get(n, 0.0) for s, n in zip(shapes, members))
            for s, n in zip(shapes, members):
                means[n] = means.get(n, 0.0) + area * s * value
                areas[n] = areas.get(n, 0.0) + area * s
        return Field(self.faces, self.nodes, self.degree,
                     {n: 2 * v - means[n] / areas[n] for n, v in self.values.items() if v},
                     self.kind)
