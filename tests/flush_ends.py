# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two arms with flush ends, one bent on to the other: of one body, and of two with small sliding."""

from itertools import product

from touchstone_test import folder

ARMS = """set Bodies = {bodies}
set Contact pairs = p
{sections}subsection Contact pair p
  set Slave body = {slave}
  set Slave boundaries = {slave_faces}
  set Master body = {master}
  set Master boundaries = {master_faces}
  set Pairing = pointwise
{more}end
subsection Load stepping
  set Steps = 6
  set End time = 1
end
"""
BODY = """subsection Body {name}
  set Fixed = {fixed}
{top}  subsection Geometry
{geometry}  end
  subsection Material
    set Young modulus = 100
    set Poisson ratio = 0.3
  end
end
"""
PRESSURE = """  set Boundary conditions = top
  subsection Boundary top
    set Pressure = 0.6 * t * if(x > 2.5, 1, 0)
  end
"""
# Layers of nodes of the clip, with the slot between the third and the fourth.
LEVELS = (0, 0.4, 0.8, 0.85, 1.25, 1.65)
COLUMNS, ROWS, LAYERS = 10, 2, len(LEVELS) - 1
SLOT = 2
GROUPS = ("bottom", "top", "slotlow", "slotup")


def write_clip():
    """The mesh of a C of which only the first column of cells goes through the layer of the slot."""
    def node(i, j, k):
        return 1 + i + (COLUMNS + 1) * (j + (ROWS + 1) * k)
    nodes = [f"{node(i, j, k)} {0.5 * i} {0.5 * j} {z}" for k, z in enumerate(LEVELS)
             for j, i in product(range(ROWS + 1), range(COLUMNS + 1))]
    corners = ((0, 0), (1, 0), (1, 1), (0, 1))
    cells, faces = [], []
    for k, j, i in product(range(LAYERS), range(ROWS), range(COLUMNS)):
        if k != SLOT or i == 0:
            cells.append([node(i + a, j + b, k + c) for c in (0, 1) for a, b in corners])
    for group, level in zip(GROUPS, (0, LAYERS, SLOT, SLOT + 1)):
        for j, i in product(range(ROWS), range(level in (SLOT, SLOT + 1), COLUMNS)):
            faces.append((1 + GROUPS.index(group), [node(i + a, j + b, level) for a, b in corners]))
    used = {n for cell in cells for n in cell}
    nodes = [line for line in nodes if int(line.split()[0]) in used]
    elements = [f"3 2 {group} {group} " + " ".join(map(str, face)) for group, face in faces]
    elements += ["5 2 100 100 " + " ".join(map(str, cell)) for cell in cells]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(GROUPS) + 1)]
    lines += [f'2 {k + 1} "{name}"' for k, name in enumerate(GROUPS)] + ['3 100 "clip"', "$EndPhysicalNames"]
    lines += ["$Nodes", str(len(nodes)), *nodes, "$EndNodes", "$Elements", str(len(elements))]
    lines += [f"{k + 1} {line}" for k, line in enumerate(elements)] + ["$EndElements", ""]
    (folder / "clip.msh").write_text("\n".join(lines), encoding="utf-8")


def one_body(name):
    """A C whose arms are as long as each other."""
    write_clip()
    body = BODY.format(name="clip", fixed="bottom", top=PRESSURE,
                       geometry="    set Type = file\n    set File = clip.msh\n")
    scene = ARMS.format(bodies="clip", sections=body, slave="clip", slave_faces="slotup", master="clip",
                        master_faces="slotlow", more="")
    (folder / f"{name}.prm").write_text(scene, encoding="utf-8")
    return folder / f"{name}.prm"


def small_sliding(name):
    """A beam whose end stands out a little over that of the block below it."""
    box = "    set Type = box\n    set Lower corner = {}\n    set Upper corner = {}\n    set Cells = {}\n"
    bodies = BODY.format(name="low", fixed="bottom", top="",
                         geometry=box.format("0.5, 0, 0", "5, 1, 0.8", "9, 2, 2"))
    bodies += BODY.format(name="up", fixed="left", top=PRESSURE,
                          geometry=box.format("0, 0, 0.85", "5.01, 1, 1.65", "10, 2, 2"))
    scene = ARMS.format(bodies="low, up", sections=bodies, slave="up", slave_faces="bottom", master="low",
                        master_faces="top", more="  set Sliding = small\n")
    (folder / f"{name}.prm").write_text(scene, encoding="utf-8")
    return folder / f"{name}.prm"
