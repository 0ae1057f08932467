# SPDX-License-Identifier: LGPL-2.1-or-later
"""A block with a slit whose sides touch or overlap as the mesh is made: however the boundaries are named, each
side alone or both as slave and master, contact is the same; sides that touch carry a uniform pressure exactly."""

from touchstone_test import below, check, checks, finish, folder, relative, run, same
from hexahedra import corners_of, write_gmsh  # of tests/, which touchstone_test finds

CELLS, LENGTH, WIDTH, SLIT_FROM = 8, 2.0, 0.25, 2


def write_mesh(name, gap, layers):
    """A block of height 1, cut open halfway up from the cell SLIT_FROM on, whose sides are the gap apart."""
    def split(corner, layer):
        return (*corner, (2 * corner[2] == layers and corner[0] > SLIT_FROM) and (1 if layer >= corner[2] else -1))

    def place(corner):
        i, j, k, side = corner
        return LENGTH * i / CELLS, WIDTH * j, k / layers + 0.5 * gap * side

    def boundary(face):
        for axis, (last, names) in enumerate(((CELLS, ("left", "right")), (1, ("front", "rear")),
                                              (layers, ("bottom", "top")))):
            for end, found in zip((0, last), names):
                if all(corner[axis] == end for corner in face):
                    return found
        return "upper" if any(corner[3] == 1 for corner in face) else "lower"

    cells = [[split(corner, k) for corner in corners_of(i, 0, k)] for i in range(CELLS) for k in range(layers)]
    write_gmsh(folder / f"{name}.msh", cells, place, boundary)


(folder / "slit.prm").write_text((checks / "slit.prm").read_text(encoding="utf-8"), encoding="utf-8")
NAMED = {"sides": ("upper", "lower"), "both": ("upper, lower", "upper, lower"), "all": ("all", "all")}


def block(mesh, named, ranks=1, **settings):
    slave, master = NAMED[named]
    return run(f"{mesh}_{named}_{ranks}" + "".join(f"_{value}" for value in settings.values()).replace(" ", "_"), "slit.prm",
               {"Body block/Geometry/File": f"{mesh}.msh", "Contact pair slit/Slave boundaries": slave,
                "Contact pair slit/Master boundaries": master,
                **{key.replace("__", "/").replace("_", " "): value for key, value in settings.items()}}, ranks)


# What nodes of the sides carry: where the slit begins the body is in one piece.
AREA = LENGTH * (CELLS - SLIT_FROM - 0.5) / CELLS * WIDTH


def pressed(result):
    return abs(result.force("slit")[2])


for layers in 4, 8:
    write_mesh(f"touching_{layers}", 0.0, layers)
    write_mesh(f"overlapping_{layers}", -0.0025, layers)
    one = block(f"overlapping_{layers}", "sides")
    check("an initial overlap" in one.log and "no master face" not in one.log, f"{one}: {one.log[:600]}")
    check(pressed(one) > 0.9 * 10 * AREA, f"overlapping: force {one.force('slit')}")
    for named in "both", "all":
        other = block(f"overlapping_{layers}", named)
        below(f"{other}, force", relative(pressed(other), pressed(one)), 1e-9)
        same(other, block(f"overlapping_{layers}", named, Contact__Enforcement="augmented lagrange"), 1e-6)
        same(other, block(f"overlapping_{layers}", named, ranks=2), 1e-9)
    for named in NAMED:
        for law in "linear elastic", "neo-Hookean":
            result = block(f"touching_{layers}", named, Body_block__Material__Law=law)
            below(f"{result}, force", relative(pressed(result), 10 * AREA), 1e-9)
finish()
