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


def read(path):
    """All nodes of a contact surface, each once."""
    nodes = {}
    for arrays in pieces(path):
        if "pair" not in arrays:
            continue
        for i in range(len(arrays["pair"])):
            def vector(name, i=i, arrays=arrays):
                return arrays[name][3 * i:3 * i + 3]

            node = Node(vector("position"), int(arrays["pair"][i]), round(arrays["status"][i]),
                        arrays["gap"][i], arrays["pressure"][i], vector("normal"),
                        vector("traction"), vector("slip"), vector("displacement"),
                        vector("force") if "force" in arrays else ())
            nodes.setdefault((node.position, node.pair), node)
    return list(nodes.values())
