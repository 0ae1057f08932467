# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads the contact surfaces that the program writes: compressed binary VTU files."""

import base64
import dataclasses
import math
import re
import struct
import zlib


@dataclasses.dataclass
class Node:
    """Result at a slave node; positions are those of the undeformed bodies."""
    position: tuple
    pair: int
    status: int  # -1 no partner, 0 open, 1 slips, 2 sticks, 3 tied
    gap: float
    pressure: float
    normal: tuple
    traction: tuple
    slip: tuple
    displacement: tuple
    force: tuple = ()

    def normal_traction(self):
        return sum(t * n for t, n in zip(self.traction, self.normal))

    def shear(self):
        p = self.normal_traction()
        return tuple(t - p * n for t, n in zip(self.traction, self.normal))

    def deformed(self):
        return tuple(x + u for x, u in zip(self.position, self.displacement))


def unpack(text, form):
    """VTK's inline format: number of blocks, size of a block and of the last one, compressed
    size of each, as 32-bit integers in base64; then the blocks."""
    text = "".join(text.split())
    if not text:  # the part of a rank without contact surface
        return ()
    blocks = struct.unpack("<I", base64.b64decode(text[:8])[:4])[0]
    head = 4 * math.ceil(4 * (3 + blocks) / 3)
    sizes = struct.unpack(f"<{3 + blocks}I", base64.b64decode(text[:head])[:4 * (3 + blocks)])[3:]
    data, result, start = base64.b64decode(text[head:]), b"", 0
    for size in sizes:
        result += zlib.decompress(data[start:start + size])
        start += size
    width = struct.calcsize(form)
    return struct.unpack(f"<{len(result) // width}{form}", result)


def pieces(path):
    """The arrays of real numbers of each piece of a file, by their names; "position" are the
    points."""
    text = path.read_text(encoding="utf-8", errors="replace")
    for piece in re.findall(r"<Piece (.*?)</Piece>", text, re.S):
        found = {}
        for bits, attributes, data in re.findall(
                r'<DataArray type="Float(32|64)"([^>]*)>\s*(.*?)\s*</DataArray>', piece, re.S):
            name = re.search(r'Name="([^"]*)"', attributes)
            found[name[1] if name else "position"] = unpack(data, "f" if bits == "32" else "d")
        yield found


def nodes_of(arrays):
    """The nodes of a piece of a contact surface in the order of its points; none of other pieces."""
    def vector(name, i):
        return arrays[name][3 * i:3 * i + 3]

    return [Node(vector("position", i), int(arrays["pair"][i]), round(arrays["status"][i]),
                 arrays["gap"][i], arrays["pressure"][i], vector("normal", i), vector("traction", i),
                 vector("slip", i), vector("displacement", i),
                 vector("force", i) if "force" in arrays else ())
            for i in range(len(arrays.get("pair", ())))]


def read(path):
    """All nodes of a contact surface, each once."""
    nodes = {}
    for arrays in pieces(path):
        for node in nodes_of(arrays):
            nodes.setdefault((node.position, node.pair), node)
    return list(nodes.values())


def faces(path):
    """The faces of a contact surface as four nodes, one after the other around the face; those of
    degree 2 are four faces."""
    text = path.read_text(encoding="utf-8", errors="replace")
    for piece, arrays in zip(re.findall(r"<Piece (.*?)</Piece>", text, re.S), pieces(path)):
        nodes = nodes_of(arrays)
        if not nodes:
            continue
        corners, ends = (unpack(re.search(f'Name="{name}"[^>]*>\\s*(.*?)\\s*</DataArray>', piece, re.S)[1], "i")
                         for name in ("connectivity", "offsets"))
        for begin, end in zip((0, *ends), ends):
            face = [nodes[i] for i in corners[begin:end]]
            # Corners, middles of the edges, centre.
            parts = ((0, 4, 8, 7), (4, 1, 5, 8), (8, 5, 2, 6), (7, 8, 6, 3)) if len(face) == 9 else ((0, 1, 2, 3),)
            yield from ([face[i] for i in part] for part in parts)
