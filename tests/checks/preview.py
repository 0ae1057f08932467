# SPDX-License-Identifier: LGPL-2.1-or-later
"""--preview: a block for the cells of each body, each boundary and obstacle with its name and its faces,
the same files on two ranks, and a drawing with all names, also as an image."""

import os
import pathlib
import re
import shutil
import xml.etree.ElementTree as xml

from touchstone_test import check, finish, launch, tests


def preview(name, scene, ranks=1, settings=()):
    done = launch("--preview", "--output", name, *settings, scene, ranks=ranks)
    check(done.returncode == 0, f"{name}: exit code {done.returncode}\n{done.stdout}")
    return pathlib.Path(name)


def blocks(path):
    """Cells, points and file of each block by its name."""
    result = {}
    for block in xml.parse(path / "preview.vtm").iter("DataSet"):
        piece = next(xml.parse(path / block.get("file")).iter("Piece"))
        coordinates = list(map(float, piece.find("Points/DataArray").text.split()))
        points = list(zip(coordinates[::3], coordinates[1::3], coordinates[2::3]))
        check(len(points) == int(piece.get("NumberOfPoints")), f"{block.get('name')}: points")
        result[block.get("name")] = int(piece.get("NumberOfCells")), points, block.get("file")
    return result


cone = preview("cone", tests / "cone_obstacle.prm")
found = blocks(cone)
sides = {f"block/{name}": 81 for name in ("left", "right", "front", "back", "bottom", "top")}
check({name: entry[0] for name, entry in found.items()} ==
      {"block, cells": 729, **sides, "obstacle indenter": 81}, f"blocks {found.keys()}")
check(all(z == 0 for x, y, z in found["block/top"][1]), "top is not at z = 0")
# The cone is at its place: z = r / tan(80 degrees).
check(all(abs(z - (x * x + y * y)**0.5 * 0.17632698) < 1e-6 for x, y, z in found["obstacle indenter"][1]),
      "the obstacle is not where it is")

svg = (cone / "preview.svg").read_text(encoding="utf-8")
xml.fromstring(svg)
texts = re.findall(r"<text[^>]*>([^<]*)", svg)
for text in ("Cone into block", "block/top, slave of contact", "obstacle indenter, master of contact"):
    check(text in texts, f"the drawing does not say {text}: {texts}")
check(svg.count("<path") > 6 * 81, "the drawing has too few faces")

two = preview("two", tests / "cone_obstacle.prm", ranks=2)
for file in sorted(cone.iterdir()):
    check(file.read_bytes() == (two / file.name).read_bytes(), f"{file.name} differs on two ranks")

# An image where there is a program for it, else its name.
if shutil.which("rsvg-convert"):
    check((cone / "preview.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n", "preview.png is no image")
broken = pathlib.Path("broken/rsvg-convert").resolve()
broken.parent.mkdir(exist_ok=True)
broken.write_text("#!/bin/sh\nexit 1\n", encoding="utf-8")
broken.chmod(0o755)
os.environ["PATH"] = f"{broken.parent}:{os.environ['PATH']}"
plain = launch("--preview", "--output", "plain", tests / "cone_obstacle.prm")
check(plain.returncode == 0 and "apt-get install librsvg2-bin" in plain.stdout and
      not pathlib.Path("plain/preview.png").exists(), f"without rsvg-convert: {plain.stdout}")

# Faces of degree 2 have four parts.
fine = preview("fine", tests / "cone_obstacle.prm", settings=("--set", "Discretisation/Degree=2"))
check(blocks(fine)["block/top"][0] == 4 * 81, "faces of degree 2")
finish()
