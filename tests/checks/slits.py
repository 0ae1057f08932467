# SPDX-License-Identifier: LGPL-2.1-or-later
"""A block with a slit whose sides touch or overlap as the mesh is made: however the boundaries are named, each
side alone or both as slave and master, contact is the same; sides that touch carry a uniform pressure exactly."""
# ctest: label = quick

from touchstone_test import below, check, checks, finish, folder, relative, run, same

CELLS, LENGTH, WIDTH, SLIT_FROM = (8, 1, 4), 2.0, 0.25, 2
CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
SIDES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (2, 3, 7, 6), (1, 2, 6, 5), (0, 4, 7, 3))


def write_mesh(name, gap, layers):
    """A block of height 1, cut open halfway up from the cell SLIT_FROM on, whose sides are the gap apart."""
    cells = (CELLS[0], CELLS[1], layers)

    def node(i, j, k, layer):
        split = 2 * k == layers and i > SLIT_FROM
        return i, j, k, split and (1 if layer >= k else -1)

    def place(i, j, k, side):
        return LENGTH * i / cells[0], WIDTH * j / cells[1], k / layers + 0.5 * gap * side

    def boundary(face):
        for axis, names in enumerate((("left", "right"), ("front", "rear"), ("bottom", "top"))):
            for end, found in zip((0, cells[axis]), names):
                if all(corner[axis] == end for corner in face):
                    return found
        return "upper" if all(corner[3] == 1 for corner in face) else "lower"

    hexahedra = [[node(i + a, j + b, k + c, k) for a, b, c in CORNERS]
                 for i in range(cells[0]) for j in range(cells[1]) for k in range(cells[2])]
    numbers = {corner: n + 1 for n, corner in enumerate(dict.fromkeys(sum(hexahedra, [])))}
    faces = {}
    for cell in hexahedra:
        for side in SIDES:
            face = tuple(cell[a] for a in side)
            faces.setdefault(frozenset(face), []).append(face)
    outer = [found[0] for found in faces.values() if len(found) == 1]
    names = sorted({boundary(face) for face in outer})
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", len(names)]
    lines += [f'2 {n + 1} "{found}"' for n, found in enumerate(names)]
    lines += ["$EndPhysicalNames", "$Nodes", len(numbers)]
    lines += [" ".join(map(repr, (n, *place(*corner)))) for corner, n in numbers.items()]
    lines += ["$EndNodes", "$Elements", len(outer) + len(hexahedra)]
    elements = [(3, names.index(boundary(face)) + 1, face) for face in outer] + [(5, 100, cell) for cell in hexahedra]
    lines += [f"{n + 1} {kind} 2 {tag} {tag} {' '.join(str(numbers[c]) for c in corners)}"
              for n, (kind, tag, corners) in enumerate(elements)]
    (folder / f"{name}.msh").write_text("\n".join(map(str, [*lines, "$EndElements", ""])), encoding="utf-8")


(folder / "slit.prm").write_text((checks / "slit.prm").read_text(encoding="utf-8"), encoding="utf-8")
NAMED = {"sides": ("upper", "lower"), "both": ("upper, lower", "upper, lower"), "all": ("all", "all")}


def block(mesh, named, ranks=1, **settings):
    slave, master = NAMED[named]
    return run(f"{mesh}_{named}_{ranks}" + "".join(f"_{value}" for value in settings.values()).replace(" ", "_"), "slit.prm",
               {"Body block/Geometry/File": f"{mesh}.msh", "Contact pair slit/Slave boundaries": slave,
                "Contact pair slit/Master boundaries": master,
                **{key.replace("__", "/").replace("_", " "): value for key, value in settings.items()}}, ranks)


# What nodes of the sides carry: where the slit begins the body is in one piece.
AREA = LENGTH * (CELLS[0] - SLIT_FROM - 0.5) / CELLS[0] * WIDTH


def pressed(result):
    return abs(result.force("slit")[2])


for layers in 4, 8:
    write_mesh(f"touching_{layers}", 0.0, layers)
    write_mesh(f"overlapping_{layers}", -0.0025, layers)
    one = block(f"overlapping_{layers}", "sides")
    check(pressed(one) > 0.9 * 10 * AREA, f"overlapping: force {one.force('slit')}")
    for named in "both", "all":
        other = block(f"overlapping_{layers}", named)
        below(f"{other}, force", relative(pressed(other), pressed(one)), 1e-9)
        same(other, block(f"overlapping_{layers}", named, Contact__Enforcement="augmented lagrange"), 1e-6)
        same(other, block(f"overlapping_{layers}", named, ranks=2), 1e-9)
    for named in NAMED:
        for law, bound in ("linear elastic", 1e-10), ("neo-Hookean", 1e-2):
            result = block(f"touching_{layers}", named, Body_block__Material__Law=law)
            below(f"{result}, force", relative(pressed(result), 10 * AREA), bound)
finish()
