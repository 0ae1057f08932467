# SPDX-License-Identifier: LGPL-2.1-or-later
"""Slave nodes whose displacement is not free, for supports, drives or other pairs determine it:
contact holds nevertheless, with every enforcement, either role and on two ranks. Edges around which
several bodies are tied or stick: patch tests, whatever the roles, angles, meshes and the order of
pairs."""

import math

from touchstone_test import (CG, ENFORCEMENT, EXACT_ENFORCEMENTS, GAP, GMRES, PENALTY, SOLVER, below,
                             finish, folder, relative, run)

E, NU = 1000., 0.3
NAMES = "abcdef"


def section(name, lines):
    return f"subsection {name}\n" + "".join(f"  {line}\n" for line in lines) + "end\n"


def scene(name, title, bodies, pairs, reference):
    """A scene of bodies (name: lines) and pairs (slave, boundary, master, boundary)."""
    text = [f"set Title = {title}", "set Bodies = " + ", ".join(bodies),
            "set Contact pairs = " + ", ".join(NAMES[:len(pairs)])]
    text += [section(f"Body {body}", lines) for body, lines in bodies.items()]
    for pair, (slave, of_slave, master, of_master) in zip(NAMES, pairs):
        text.append(section(f"Contact pair {pair}", [
            f"set Slave body = {slave}", f"set Slave boundaries = {of_slave}",
            f"set Master body = {master}", f"set Master boundaries = {of_master}"]))
    text += [section("Reference solution", reference), section("Output", ["set VTU interval = 0"])]
    (folder / name).write_text("\n".join(text) + "\n", encoding="utf-8")
    return name


def material(poisson=NU):
    return ["subsection Material", f"set Young modulus = {E}", f"set Poisson ratio = {poisson}", "end"]


def box(lower, upper, cells):
    return ["subsection Geometry", "set Type = box", f"set Lower corner = {lower}",
            f"set Upper corner = {upper}", f"set Cells = {cells}", "end"]


def star(name, angles, cells, roles, strain=None):
    """Rhombs around an edge, in plane strain: pressed from all sides with the pressure 10, or with the
    displacement of a uniform strain (xx, yy, xy) prescribed. @param angles Between neighbours, they
    sum up to 360 degrees. @param roles Whether body k is slave of body k + 1."""
    n = len(angles)
    first = [math.radians(25 + sum(angles[:k])) for k in range(n)]
    e = [(math.cos(a), math.sin(a)) for a in first]
    given = -10 * (1 + NU) * (1 - 2 * NU) / E
    xx, yy, xy = strain or (given, given, 0)
    u = {"x": f"({xx}*x + {xy}*y)", "y": f"({xy}*x + {yy}*y)"}
    bodies, pairs = {}, []
    for k in range(n):
        p, q = e[k], e[(k + 1) % n]
        corners = [(0, 0), p, (p[0] + q[0], p[1] + q[1]), q]
        lines = ["set Symmetry = bottom, top", "set Boundary conditions = right, back"]
        lines += [f"set Reference displacement {d} = {u[d]}" for d in "xy"]
        lines += ["subsection Geometry", "set Type = block", "set Corners = " +
                  "; ".join(f"{x:.15g}, {y:.15g}, 0" for x, y in corners),
                  f"set Cells = {cells[k]}", "end"] + material()
        for side in "right", "back":
            driven = strain or (k == 0 and side == "right")
            lines += [f"subsection Boundary {side}"]
            lines += [f"set Displacement {d} = {u[d]} * t" for d in "xy"] if driven \
                else ["set Pressure = 10 * t"]
            lines += ["end"]
        bodies[f"body{k}"] = lines
        sides = (f"body{k}", "left"), (f"body{(k + 1) % n}", "front")
        pairs.append((*sides[0], *sides[1]) if roles[k] else (*sides[1], *sides[0]))
    reference = ["set Type = formula"] + ([] if strain else ["set Pressure = 10"])
    return scene(name, "bodies around an edge", bodies, pairs, reference)


def kind(n, **keys):
    """The same keys for all pairs."""
    return {f"Contact pair {pair}/{key.replace('_', ' ')}": value
            for pair in NAMES[:n] for key, value in keys.items()}


def tied(n):
    return kind(n, Behaviour="tied")


def rough(n):
    return {**kind(n, Behaviour="coulomb"),
            **{f"Contact pair {pair}/Friction/Coefficient": 0.5 for pair in NAMES[:n]}}


def patch(name, path, settings, pressure=True, ranks=1, bound=1e-7):
    """A run that meets the exact solution."""
    result = run(name, path, {GAP: 1e-10, **settings}, ranks)
    for error in ("displacement_l2", "pressure_l2")[:1 + pressure]:
        below(f"{name}, {error}", result.error(error), bound)
    return result


CIRCLE, CHAIN = (True, True, True), (True, True, False)
THREE = star("three.prm", (120, 120, 120), ("3, 3, 1", "4, 4, 1", "3, 5, 2"), CIRCLE)
EXCHANGED = star("exchanged.prm", (95, 150, 115), ("3, 3, 2", "4, 4, 3", "3, 5, 1"), CHAIN)
FOUR = star("four.prm", (90, 80, 100, 90), ("3, 3, 1", "4, 2, 2", "2, 5, 1", "3, 3, 3"),
            (True, False, True, True))
for path, n in (THREE, 3), (EXCHANGED, 3), (FOUR, 4):
    for way, settings in ("tied", tied(n)), ("rough", rough(n)):
        name = f"{path[:-4]}_{way}"
        for enforcement in EXACT_ENFORCEMENTS if n == 3 else ("elimination",):
            patch(f"{name}_{enforcement}", path, {**settings, ENFORCEMENT: enforcement})
    patch(f"{path[:-4]}_rough_2", path, rough(n), ranks=2)
# One pair without friction beside two that are tied.
patch("mixed", THREE, {**tied(3), "Contact pair c/Behaviour": "frictionless"})
# Shear, too: all that is tied moves as one body.
for path, n in (star("sheared.prm", (100, 130, 130), ("3, 3, 2", "3, 3, 1", "3, 3, 3"), CIRCLE,
                     (-0.004, 0.001, 0.003)), 3), :
    for enforcement in EXACT_ENFORCEMENTS:
        patch(f"sheared_{enforcement}", path, {**tied(n), ENFORCEMENT: enforcement}, pressure=False)

# Both sides of each interface are held at its outer end: rows there have nothing to determine, and others take their
# part, of the force of the pair, too.
HELD = -10 * (1 + NU) * (1 - 2 * NU) / E
for path, settings in ((star("held.prm", (100, 130, 130), ("3, 3, 2", "4, 4, 2", "5, 7, 3"), CIRCLE,
                             (HELD, HELD, 0)), {"smooth": {}, "tied": tied(3), "rough": rough(3)}),
                       (star("held_shear.prm", (100, 130, 130), ("3, 3, 2", "4, 4, 2", "5, 7, 3"), CIRCLE,
                             (-0.004, 0.001, 0.003)), {"tied": tied(3)})):
    for way, of_pairs in settings.items():
        for ranks in (1, 2) if way == "tied" else (1,):
            result = patch(f"{path[:-4]}_{way}_{ranks}", path, of_pairs, pressure=False, ranks=ranks)
            if path == "held.prm":
                for pair in "abc":
                    below(f"{result}, force of {pair}", relative(math.hypot(*result.force(pair)), 10),
                          1e-7)

# Tied pointwise rows on meshes that match around the edge say more than there is to say, and forces that go around the
# edge and back are not determined: those are taken that continue the tractions beside it.
for path, n in ((star("matching.prm", (100, 130, 130), ("3, 3, 1",) * 3, CIRCLE), 3),
                (star("chain.prm", (100, 130, 130), ("3, 3, 2",) * 3, CHAIN), 3),
                (star("matching_four.prm", (90, 80, 100, 90), ("3, 3, 2",) * 4,
                      (True, False, True, True)), 4)):
    for enforcement in EXACT_ENFORCEMENTS:
        result = patch(f"{path[:-4]}_{enforcement}", path,
                       {**kind(n, Pairing="pointwise", Behaviour="tied"), ENFORCEMENT: enforcement})
        for pair in NAMES[:n]:
            below(f"{result}, force of {pair}", relative(math.hypot(*result.force(pair)), 10), 1e-7)
    patch(f"{path[:-4]}_2", path, kind(n, Pairing="pointwise", Behaviour="tied"), ranks=2)
patch("matching_four_steps", path, {**kind(4, Pairing="pointwise", Behaviour="tied"),
                                    "Load stepping/Steps": 4})

# A plate over two blocks: its nodes over both are slaves of two pairs with the same normal.
def over(name, cells, order):
    z = ["set Reference displacement x = 0", "set Reference displacement y = 0",
         "set Reference displacement z = -0.01*z"]
    bodies = {
        "left": ["set Symmetry = left, front, bottom", *z, *box("0, 0, 0", "1, 1, 1", cells[0])],
        "right": ["set Symmetry = front, bottom", "set Boundary conditions = right", *z,
                  "subsection Boundary right", "set Displacement x = 0", "end",
                  *box("1, 0, 0", "2, 1, 1", cells[1])],
        "upper": ["set Symmetry = left, front", "set Boundary conditions = top", *z,
                  "subsection Boundary top", "set Pressure = 10 * t", "end",
                  *box("0, 0, 1", "2, 1, 2", cells[2])]}
    bodies = {body: lines + material(0.) for body, lines in bodies.items()}
    return scene(name, "plate over two blocks", bodies,
                 [("upper", "bottom", body, "top") for body in order], ["set Type = formula"])


def balanced(result):
    for pair in "ab":
        below(f"{result}, force of {pair}", relative(result.force(pair)[2], 10), 1e-7)


CELLS = "3, 3, 2", "2, 4, 2", "4, 3, 2"
OVER = over("over.prm", CELLS, ("left", "right"))
for way, settings in {"smooth": {}, "tied": tied(2), "rough": rough(2)}.items():
    for enforcement in EXACT_ENFORCEMENTS:
        balanced(patch(f"over_{way}_{enforcement}", OVER, {**settings, ENFORCEMENT: enforcement},
                       pressure=False))
SAME_CELLS = over("over_pointwise.prm", ("2, 3, 2", "2, 3, 2", "4, 3, 2"), ("left", "right"))
patch("over_pointwise", SAME_CELLS, kind(2, Pairing="pointwise"), pressure=False)
patch("over_2", OVER, {}, pressure=False, ranks=2)
for solver in CG, GMRES:
    patch(f"over_{solver['Linear solver/Type'][6:]}", OVER, solver, pressure=False)
patch("over_other_order", over("other.prm", CELLS, ("right", "left")), {}, pressure=False)

# Slave faces over the joint of several masters, inside them, along their sides or across, at corners, and where
# pairs cover parts of the same face as their slave or as their master: together they cover all of it. Uniaxial strain.
def joint(name, blocks, cells, pairs):
    """A plate over blocks. @param blocks name: (corners in the plane, cells).
    @param pairs (block, whether the plate is the slave)."""
    exact = ["set Reference displacement x = 0", "set Reference displacement y = 0",
             "set Reference displacement z = -0.01*z"]
    fixed = [f"set Displacement {d} = 0" for d in "xyz"]
    bodies = {}
    for block, (corners, of_block) in blocks.items():
        bodies[block] = ["set Boundary conditions = bottom", *exact, "subsection Boundary bottom",
                         *fixed, "end", "subsection Geometry", "set Type = block",
                         "set Corners = " + "; ".join(f"{x}, {y}, 0" for x, y in corners),
                         f"set Cells = {of_block}", "end"]
    bodies["plate"] = ["set Symmetry = left, front", "set Boundary conditions = top", *exact,
                       "subsection Boundary top", "set Pressure = 10 * t", "end",
                       *box("0, 0, 1", "2, 2, 2", cells)]
    bodies = {body: lines + material(0.) for body, lines in bodies.items()}
    sides = [[("plate", "bottom"), (block, "top")][::1 if slave else -1] for block, slave in pairs]
    return scene(name, "plate over blocks", bodies, [(*a, *b) for a, b in sides],
                 ["set Type = formula"])


def rectangle(x, y, end_x, end_y):
    return (x, y), (end_x, y), (end_x, end_y), (x, end_y)


MIDDLE = {"one": (rectangle(0, 0, 1, 2), "3, 4, 2"), "two": (rectangle(1, 0, 2, 2), "3, 4, 2")}
OBLIQUE = {"one": (((0, 0), (0.7, 0), (1.2, 2), (0, 2)), "3, 4, 2"),
           "two": (((0.7, 0), (2, 0), (2, 2), (1.2, 2)), "4, 3, 2")}
CORNERS = {"one": (rectangle(0, 0, 0.9, 1.2), "2, 3, 1"), "two": (rectangle(0.9, 0, 2, 1.2), "3, 2, 1"),
           "three": (rectangle(0, 1.2, 0.9, 2), "2, 2, 1"),
           "four": (rectangle(0.9, 1.2, 2, 2), "2, 3, 1")}
STRIPS = {"one": (rectangle(0, 0, 0.8, 2), "2, 3, 1"), "two": (rectangle(0.8, 0, 1.1, 2), "1, 3, 1"),
          "three": (rectangle(1.1, 0, 2, 2), "2, 4, 1")}
for way, blocks in {"middle": MIDDLE, "oblique": OBLIQUE, "corners": CORNERS, "strips": STRIPS}.items():
    n = len(blocks)
    for cells in "1, 1, 1", "3, 3, 2":
        name = f"joint_{way}_{cells[0]}"
        path = joint(f"{name}.prm", blocks, cells, [(block, True) for block in blocks])
        for law, settings in {"smooth": {}, "tied": tied(n), "rough": rough(n)}.items():
            patch(f"{name}_{law}", path, settings, pressure=False)
        # The first and the third block are masters of the plate, the others its slaves.
        mixed = joint(f"{name}_mixed.prm", blocks, cells,
                      [(block, k % 2 == 0) for k, block in enumerate(blocks)])
        patch(f"{name}_mixed", mixed, {}, pressure=False)
    for enforcement in EXACT_ENFORCEMENTS[1:]:
        patch(f"{name}_{enforcement}", path, {ENFORCEMENT: enforcement}, pressure=False)
    patch(f"{name}_2", path, {}, pressure=False, ranks=2)
    patch(f"{name}_small", path, kind(n, Sliding="small"), pressure=False)
    patch(f"{name}_gmres", path, {**rough(n), **GMRES}, pressure=False)

# A surface that is driven is slave: the master gives way, as it does with the roles exchanged. Meshes
# match, so that pointwise rows say the same with either role.
def rib(name, slave, master, support):
    bodies = {
        "low": ["set Fixed = bottom", *box("-1, -1, -1", "1, 1, 0", "4, 4, 2"), *material()],
        "rib": [f"set Boundary conditions = {support}", f"subsection Boundary {support}",
                "set Displacement x = 0", "set Displacement y = 0",
                "set Displacement z = -0.012 * t", "end",
                *box("-0.5, -0.5, 0", "0.5, 0.5, 0.4", "2, 2, 1"), *material()]}
    return scene(name, "driven surface", bodies, [(*slave, *master)], ["set Type = none"])


sides = ("rib", "bottom"), ("low", "top")
POINTS = {**kind(1, Pairing="pointwise", Sliding="small"), GAP: 1e-10}
DRIVEN, OTHER = rib("driven.prm", *sides, "bottom"), rib("roles.prm", *sides[::-1], "bottom")
for way, settings in {"smooth": {}, "tied": tied(1), "rough": rough(1)}.items():
    expected = -run(f"roles_{way}", OTHER, {**POINTS, **settings}).force("a")[2]
    for enforcement in EXACT_ENFORCEMENTS:
        result = run(f"driven_{way}_{enforcement}", DRIVEN,
                     {**POINTS, **settings, ENFORCEMENT: enforcement})
        below(f"{result}, force", relative(result.force("a")[2], expected), 1e-6)
        below(f"{result}, balance", relative(result.reaction("low", "bottom")[2],
                                             result.force("a")[2]), 1e-6)
    two = run(f"driven_{way}_2", DRIVEN, {**POINTS, **settings}, ranks=2)
    below(f"{two}, force", relative(two.force("a")[2], expected), 1e-6)
    for solver in (GMRES,) if way == "rough" else (CG, GMRES):
        result = run(f"driven_{way}_{solver[SOLVER]}", DRIVEN, {**POINTS, **settings, **solver})
        below(f"{result}, force", relative(result.force("a")[2], expected), 1e-6)
soft = run("driven_penalty", DRIVEN, {**POINTS, **PENALTY})
below("driven, penalty", relative(soft.force("a")[2], result.force("a")[2]), 0.2)
finish()
