# SPDX-License-Identifier: LGPL-2.1-or-later
"""Slave nodes whose displacement is not free, for supports, drives or other pairs determine it:
contact holds nevertheless, with every enforcement, either role and on two ranks. Edges around which
several bodies are tied or stick: patch tests, whatever the roles, angles, meshes and the order of
pairs. Pointwise ties of meshes that do not match are named in a warning."""

import math

from touchstone_test import (CG, ENFORCEMENT, EXACT_ENFORCEMENTS, GAP, GMRES, PENALTY, STEPS, below, check, checks,
                             finish, folder, relative, run, stopped_and_resumed, tests)

E, NU = 1000., 0.3
NAMES = "abcdefgh"


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


def star(name, angles, cells, roles, strain=None, away=""):
    """Rhombs around an edge, in plane strain: pressed from all sides with the pressure 10, or with the
    displacement of a uniform strain (xx, yy, xy) prescribed. @param angles Between neighbours, they
    sum up to 360 degrees. @param roles Whether body k is slave of body k + 1. @param away Distance of
    the last body from the others over the time, from 2 to 0: only then all are strained."""
    n = len(angles)
    first = [math.radians(25 + sum(angles[:k])) for k in range(n)]
    e = [(math.cos(a), math.sin(a)) for a in first]
    given = -10 * (1 + NU) * (1 - 2 * NU) / E
    xx, yy, xy = strain or (given, given, 0)
    bodies, pairs = {}, []
    for k in range(n):
        p, q = e[k], e[(k + 1) % n]
        middle = first[k] + math.radians(angles[k]) / 2
        distance = 2. if away and k == n - 1 else 0.
        d = distance * math.cos(middle), distance * math.sin(middle)
        corners = [(x + d[0], y + d[1]) for x, y in ((0, 0), p, (p[0] + q[0], p[1] + q[1]), q)]
        x, y = f"(x - ({d[0]:.15g}))", f"(y - ({d[1]:.15g}))"
        u = {"x": f"({xx}*{x} + {xy}*{y})", "y": f"({xy}*{x} + {yy}*{y})"}
        back = {"x": f"{d[0]:.15g}", "y": f"{d[1]:.15g}"}
        lines = ["set Symmetry = bottom, top", "set Boundary conditions = right, back"]
        lines += [f"set Reference displacement {d} = {u[d]} - ({back[d]})" for d in "xy"]
        lines += ["subsection Geometry", "set Type = block", "set Corners = " +
                  "; ".join(f"{x:.15g}, {y:.15g}, 0" for x, y in corners),
                  f"set Cells = {cells[k]}", "end"] + material()
        for side in "right", "back":
            driven = strain or (k == 0 and side == "right")
            lines += [f"subsection Boundary {side}"]
            strained = f"{u['x']} * t", f"{u['y']} * t"
            if away:
                strained = tuple(f"{u[d]} * max(0, 4*t - 3) - ({back[d]}) * (1 - ({away}) / 2)" for d in "xy")
            lines += [f"set Displacement {d} = {strained[d == 'y']}" for d in "xy"] if driven \
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


def rough(n, coefficient=0.5):
    return {**kind(n, Behaviour="coulomb"),
            **{f"Contact pair {pair}/Friction/Coefficient": coefficient for pair in NAMES[:n]}}


def patch(name, path, values, pressure=True, ranks=1, bound=1e-7):
    """A run that meets the exact solution."""
    result = run(name, path, {GAP: 1e-10, **values}, ranks)
    for error in ("displacement_l2", "pressure_l2")[:1 + pressure]:
        below(f"{name}, {error}", result.error(error), bound)
    return result


def settings(*several):
    """All of some dictionaries, and enforcements by their names."""
    return {key: value for one in several
            for key, value in ({ENFORCEMENT: one} if isinstance(one, str) else one).items()}


# Each law meets each enforcement once, each scene two laws: what goes wrong in all scenes, or with all
# enforcements, is seen in one.
ELIMINATION, LAGRANGE, OUTER = EXACT_ENFORCEMENTS
CYCLE, CHAIN = (True, True, True), (True, True, False)
THREE = star("three.prm", (120, 120, 120), ("3, 3, 1", "4, 4, 1", "3, 5, 2"), CYCLE)
EXCHANGED = star("exchanged.prm", (95, 150, 115), ("3, 3, 2", "4, 4, 3", "3, 5, 1"), CHAIN)
FOUR = star("four.prm", (90, 80, 100, 90), ("3, 3, 1", "4, 2, 2", "2, 5, 1", "3, 3, 3"),
            (True, False, True, True))
patch("three_tied", THREE, tied(3))
patch("three_rough", THREE, settings(rough(3), LAGRANGE))
patch("exchanged_tied", EXCHANGED, settings(tied(3), LAGRANGE))
patch("exchanged_rough", EXCHANGED, settings(rough(3), OUTER), ranks=2)
patch("four_tied", FOUR, settings(tied(4), OUTER))
patch("four_rough", FOUR, rough(4), ranks=2)
# One pair without friction beside two that are tied.
patch("mixed", THREE, {**tied(3), "Contact pair c/Behaviour": "frictionless"})
# Shear, too: all that is tied moves as one body.
SHEARED = star("sheared.prm", (100, 130, 130), ("3, 3, 2", "3, 3, 1", "3, 3, 3"), CYCLE,
               (-0.004, 0.001, 0.003))
patch("sheared", SHEARED, settings(tied(3), LAGRANGE), pressure=False)

# Both sides of each interface are held at its outer end: rows there have nothing to determine, and others take their
# part, of the force of the pair, too.
HELD = -10 * (1 + NU) * (1 - 2 * NU) / E
OUTSIDE = star("held.prm", (100, 130, 130), ("3, 3, 2", "4, 4, 2", "5, 7, 3"), CYCLE, (HELD, HELD, 0))
MATCHING = star("held_matching.prm", (100, 130, 130), ("3, 3, 1",) * 3, CYCLE, (HELD, HELD, 0))
POINTWISE = kind(3, Pairing="pointwise")
for name, path, of_pairs, n_ranks in (("held_smooth", OUTSIDE, {}, 1), ("held_tied", OUTSIDE, tied(3), 2),
                                      ("held_rough", OUTSIDE, rough(3), 1),
                                      ("held_pointwise", MATCHING, settings(POINTWISE, rough(3)), 1)):
    result = patch(name, path, of_pairs, pressure=False, ranks=n_ranks)
    for pair in "abc":
        below(f"{result}, force of {pair}", relative(math.hypot(*result.force(pair)), 10), 1e-7)
patch("held_shear", star("held_shear.prm", (100, 130, 130), ("3, 3, 2", "4, 4, 2", "5, 7, 3"), CYCLE,
                         (-0.004, 0.001, 0.003)), tied(3), pressure=False)

# The last body arrives during the run, leaves and arrives again: joints form and dissolve, inside and where supports
# hold both sides. Without that the pairs' forces are 8.7 to 10 (matching meshes: 7.8 to 9.8).
LATE = star("late.prm", (100, 130, 130), ("3, 3, 2", "4, 4, 2", "5, 7, 3"), CYCLE, (HELD, HELD, 0),
            away="8 * abs(0.25 - t) * (t < 0.5) + 8 * max(0.75 - t, 0) * (t >= 0.5)")
ONCE = "8 * max(0.25 - t, 0)"
LATE_TIED = star("late_tied.prm", (100, 130, 130), ("3, 3, 2", "4, 4, 2", "5, 7, 3"), CYCLE, (HELD, HELD, 0), away=ONCE)
LATE_MATCHING = star("late_matching.prm", (100, 130, 130), ("3, 3, 1",) * 3, CYCLE, (HELD, HELD, 0), away=ONCE)
for name, path, of_pairs, n_ranks, steps in (
        ("late_smooth", LATE, LAGRANGE, 1, 8), ("late_rough", LATE, rough(3), 2, 8),
        ("late_tied", LATE_TIED, settings(rough(3), OUTER, {"Contact pair a/Behaviour": "tied"}), 1, 4),
        ("late_pointwise", LATE_MATCHING, settings(POINTWISE, rough(3)), 1, 4),
        # Arrived and strained in one step.
        ("late_one_step", LATE_TIED, {}, 1, 1)):
    values = settings(of_pairs, {GAP: 1e-10, STEPS: steps})
    # Stopped while the body is where it has no joints, or has them.
    result = run(name, path, values) if n_ranks == 1 else stopped_and_resumed(name, path, values, 3, n_ranks)
    below(f"{result}, displacement", result.error("displacement_l2"), 1e-7)
    for pair in "abc":
        below(f"{result}, force of {pair}", relative(math.hypot(*result.force(pair)), 10), 1e-7)

# It leaves before the others are strained: they are as if it had never been there.
LEFT = {name: star(f"{name}.prm", (100, 130, 130), ("3, 3, 2", "4, 4, 2", "5, 7, 3"), CYCLE, (HELD, HELD, 0), away=way)
        for name, way in (("left", "8 * abs(0.25 - t) * (t < 0.5) + 2 * (t >= 0.5)"), ("never", "2 + 0 * t"))}
left, never = (math.hypot(*run(name, path, settings(rough(3), {STEPS: 4, "Contact pair a/Behaviour": "tied"})).force("a"))
               for name, path in LEFT.items())
below("force between the bodies that are left", relative(left, never), 1e-7)

# Pointwise rows on meshes that match: nodes of the edge leave their parts to their neighbours, or forces that go
# around the edge from body to body would decide who slips.
AROUND = (star("matching.prm", (100, 130, 130), ("3, 3, 1",) * 3, CYCLE),
          star("chain.prm", (95, 150, 115), ("1, 1, 2",) * 3, CHAIN),
          star("matching_four.prm", (90, 80, 100, 90), ("3, 3, 2",) * 4, (True, False, True, True)))
for name, k, of_pairs, n_ranks in (("matching_tied", 0, tied(3), 1), ("matching_rough", 0, rough(3), 1),
                                   ("matching_lagrange", 0, settings(rough(3, 0.1), LAGRANGE), 1),
                                   ("chain_tied", 1, settings(tied(3), LAGRANGE), 1),
                                   ("chain_rough", 1, settings(rough(3, 0.1), OUTER), 2),
                                   ("four_steps", 2, {**rough(4, 1), "Load stepping/Steps": 4}, 2)):
    result = patch(f"pointwise_{name}", AROUND[k], settings(kind(4 if k == 2 else 3, Pairing="pointwise"), of_pairs),
                   ranks=n_ranks)
    for pair in NAMES[:4 if k == 2 else 3]:
        below(f"{result}, force of {pair}", relative(math.hypot(*result.force(pair)), 10), 1e-7)

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
for name, of_pairs in (("smooth", {}), ("tied", tied(2)), ("rough", rough(2))):
    for enforcement in EXACT_ENFORCEMENTS if name == "tied" else EXACT_ENFORCEMENTS[:1]:
        balanced(patch(f"over_{name}_{enforcement}", OVER, settings(of_pairs, enforcement), pressure=False))
patch("over_pointwise", over("over_pointwise.prm", ("2, 3, 2", "2, 3, 2", "4, 3, 2"), ("left", "right")),
      kind(2, Pairing="pointwise"), pressure=False)
patch("over_2", OVER, GMRES, pressure=False, ranks=2)
patch("over_other_order", over("other.prm", CELLS, ("right", "left")), CG, pressure=False)

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
WAYS = {"middle": MIDDLE, "oblique": OBLIQUE, "corners": CORNERS, "strips": STRIPS}
LAWS = {"smooth": lambda n: {}, "tied": tied, "rough": rough}
FURTHER = [lambda n: {ENFORCEMENT: LAGRANGE}, lambda n: {ENFORCEMENT: OUTER},
           lambda n: kind(n, Sliding="small"), lambda n: {**rough(n), **GMRES}]
for k, (way, blocks) in enumerate(WAYS.items()):
    n, all_slave = len(blocks), [(block, True) for block in blocks]
    for j, cells in enumerate(("1, 1, 1", "3, 3, 2")):
        name = f"joint_{way}_{cells[0]}"
        path = joint(f"{name}.prm", blocks, cells, all_slave)
        law = list(LAWS)[(k + j) % 3]
        patch(f"{name}_{law}", path, LAWS[law](n), pressure=False, ranks=2 if k == 3 else 1)
    # The first and the third block are masters of the plate, the others its slaves.
    mixed = joint(f"{name}_mixed.prm", blocks, "1, 1, 1" if k % 2 else "3, 3, 2",
                  [(block, i % 2 == 0) for i, block in enumerate(blocks)])
    patch(f"{name}_mixed", mixed, {}, pressure=False)
    patch(f"{name}_further", path, FURTHER[k](n), pressure=False)
# Through a node of the plate: the tip of what a block covers of a face is round-off.
THROUGH = joint("through_node.prm", OBLIQUE, "5, 2, 2", [("one", True), ("two", True)])
patch("through_node", THROUGH, {}, pressure=False)

# A block that is cut into boxes: T-joints, vertices of four bodies, slave faces over several masters, slaves of several
# pairs. Uniform strain.
def partition(name, boxes, pairs):
    """@param boxes (lower corner, upper corner, cells). @param pairs (slave box, its side, master box)."""
    strain, sides = (-0.004, -0.006, -0.01), (("left", "right"), ("front", "back"), ("bottom", "top"))
    end = [max(upper[d] for _, upper, _ in boxes) for d in range(3)]
    bodies = {}
    for k, (lower, upper, cells) in enumerate(boxes):
        lines = [f"set Reference displacement {'xyz'[d]} = {strain[d]} * {'xyz'[d]}" for d in range(3)]
        driven = [d for d in range(3) if upper[d] == end[d]]
        for what, which in (("Symmetry", [sides[d][0] for d in range(3) if lower[d] == 0]),
                            ("Boundary conditions", [sides[d][1] for d in driven])):
            lines += [f"set {what} = {', '.join(which)}"] if which else []
        for d in driven:
            lines += [f"subsection Boundary {sides[d][1]}",
                      f"set Displacement {'xyz'[d]} = {strain[d] * end[d]} * t", "end"]
        corners = [", ".join(map(str, corner)) for corner in (lower, upper)]
        bodies[f"box{k}"] = lines + box(*corners, cells) + material()
    other = {a: b for pair in sides for a, b in (pair, pair[::-1])}
    return scene(name, "boxes", bodies, [(f"box{a}", side, f"box{b}", other[side]) for a, side, b in pairs],
                 ["set Type = formula"])


FIVE = partition("five.prm", [((0, 0, 0), (2, 0.7, 1.5), "2, 2, 1"), ((0, 0.7, 0), (2, 1.1, 1.5), "2, 3, 1"),
                              ((0, 1.1, 0), (0.8, 2, 1.5), "3, 2, 2"), ((0.8, 1.1, 0), (2, 2, 0.9), "3, 2, 1"),
                              ((0.8, 1.1, 0.9), (2, 2, 1.5), "1, 3, 1")],
                 [(0, "back", 1), (2, "front", 1), (1, "back", 3), (1, "back", 4), (3, "left", 2), (2, "right", 4),
                  (4, "bottom", 3)])
T_JOINT = partition("t_joint.prm", [((0, 0, 0), (2, 0.6, 1.5), "3, 2, 1"), ((0, 0.6, 0), (0.7, 2, 1.5), "1, 1, 2"),
                                    ((0.7, 0.6, 0), (2, 1.2, 1.5), "1, 3, 2"), ((0.7, 1.2, 0), (2, 2, 0.4), "2, 2, 2"),
                                    ((0.7, 1.2, 0.4), (2, 2, 1.5), "1, 1, 3")],
                    [(1, "front", 0), (0, "back", 2), (1, "right", 2), (3, "left", 1), (4, "left", 1), (2, "back", 3),
                     (2, "back", 4), (4, "bottom", 3)])
patch("five_tied", FIVE, settings(tied(7), LAGRANGE), pressure=False)
patch("five_rough", FIVE, rough(7), pressure=False, ranks=2)
patch("t_joint_tied", T_JOINT, settings(tied(8), OUTER), pressure=False)
patch("t_joint_rough", T_JOINT, rough(8, 0.1), pressure=False)

# Beside driven faces supports determine most of what rows say along the surface, and the few nodes that are free follow the
# bodies: such rows neither slide nor stick, and converge with solvers that leave a slip.
def laws(**of_pairs):
    """Laws by the names of pairs: a coefficient of friction, or 'tied'."""
    values = {}
    for pair, law in of_pairs.items():
        values.update({f"Contact pair {pair}/Behaviour": "tied"} if law == "tied" else
                      {f"Contact pair {pair}/Behaviour": "coulomb", f"Contact pair {pair}/Friction/Coefficient": law})
    return values


HELD_STICK = partition("held_stick.prm", [
    ((0, 0, 0.45), (2, 0.8, 1.5), "1, 2, 1"), ((0, 0.8, 0.45), (1, 2, 1.5), "3, 1, 3"),
    ((1, 0.8, 0.45), (2, 2, 1.5), "2, 3, 3"), ((0, 0, 0), (1, 2, 0.45), "3, 2, 1"), ((1, 0, 0), (2, 2, 0.45), "2, 3, 2")],
    [(0, "back", 1), (0, "back", 2), (1, "right", 2), (0, "bottom", 3), (1, "bottom", 3), (3, "right", 4), (4, "top", 0),
     (4, "top", 2)])
LAWS_HELD = laws(a=0.7, b="tied", c=0.3, d="tied", e="tied", f=0.05, h=0.05)
for name, further, n_ranks in (("mumps", {}, 1), ("gmres", GMRES, 2)):
    result = patch(f"held_stick_{name}", HELD_STICK, settings(LAWS_HELD, further), pressure=False, ranks=n_ranks)
    below(f"{result}, Newton iterations", result.iterations(), 10.5)
# Rows that stick in a cycle of pairs keep their conditions along the normal.
CYCLE_OF_STICK = partition("cycle_of_stick.prm", [
    ((0, 0, 0), (2, 0.6, 1.5), "3, 2, 1"), ((0, 0.6, 0), (0.66, 2, 1.5), "1, 1, 2"), ((0.66, 0.6, 0), (2, 1.16, 1.5), "1, 3, 2"),
    ((0.66, 1.16, 0), (2, 2, 0.45), "2, 2, 2"), ((0.66, 1.16, 0.45), (2, 2, 1.5), "1, 1, 3")],
    [(1, "front", 0), (0, "back", 2), (1, "right", 2), (3, "left", 1), (4, "left", 1), (2, "back", 3), (2, "back", 4),
     (4, "bottom", 3)])
for name, further, n_ranks in (("mumps", {}, 2), ("augmented", settings(OUTER), 1)):
    patch(f"cycle_of_stick_{name}", CYCLE_OF_STICK, settings(laws(b="tied", f=1, g=0.3, h="tied"), further),
          pressure=False, ranks=n_ranks)

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
for way, law, several in (("smooth", {}, [(OUTER, {}, 1), (ELIMINATION, CG, 1)]),
                          ("tied", tied(1), [(LAGRANGE, {}, 1), (ELIMINATION, {}, 2)]),
                          ("rough", rough(1), [(LAGRANGE, {}, 2), (OUTER, {}, 1), (ELIMINATION, GMRES, 1)])):
    expected = -run(f"roles_{way}", OTHER, {**POINTS, **law}).force("a")[2]
    for k, (enforcement, solver, n_ranks) in enumerate(several):
        result = run(f"driven_{way}_{k}", DRIVEN, settings(POINTS, law, enforcement, solver), n_ranks)
        below(f"{result}, force", relative(result.force("a")[2], expected), 1e-6)
        below(f"{result}, balance", relative(result.reaction("low", "bottom")[2], result.force("a")[2]), 1e-6)
soft = run("driven_penalty", DRIVEN, {**POINTS, **PENALTY})
below("driven, penalty", relative(soft.force("a")[2], result.force("a")[2]), 0.2)

# Forces of two bricks on a third that is pushed across their joint: its weight and tractions, without a cut.
for enforcement, n_ranks in (LAGRANGE, 1), (ELIMINATION, 2):
    brick = run(f"brick_{n_ranks}", checks / "brick_on_joint.prm", settings(enforcement, {GAP: 1e-10}), n_ranks)
    check(brick.cuts() == 0, f"{brick}: steps were cut")
    for d, expected in (0, -2), (2, 8):
        below(f"{brick}, force {d}", relative(sum(brick.force(side)[d] for side in ("bed left", "bed right")), expected),
              1e-7)

# A block tied to, or pressed on, three bases whose joints lie inside its faces, or on its nodes: one row for
# each of its nodes, and so one answer, which all find quickly.
def on_bases(name, cells):
    bodies = {f"base{k}": ["set Fixed = bottom",
                           *box(f"{2 * k}, 0, -1", f"{2 * k + 2}, 2, 0", f"{3 + k}, 3, 2"), *material()] for k in range(3)}
    bodies["block"] = ["set Boundary conditions = top", "subsection Boundary top", "set Displacement x = 0",
                       "set Displacement y = 0", "set Displacement z = -0.02 * t", "end",
                       *box("1, 0.3, 0", "5, 1.7, 1", cells), *material()]
    return scene(name, "block on joints", bodies, [("block", "bottom", f"base{k}", "top") for k in range(3)],
                 ["set Type = none"])


for joints, cells in ("inside", "9, 4, 2"), ("nodes", "8, 4, 2"):
    path = on_bases(f"joints_{joints}.prm", cells)
    for law, ways in (("tied", ((ELIMINATION, {}, 1),)),
                      ("rough", ((ELIMINATION, {}, 1), (OUTER, {}, 1), (ELIMINATION, CG, 2)))):
        first = None
        for k, (enforcement, solver, n_ranks) in enumerate(ways):
            result = run(f"joints_{joints}_{law}_{k}", path, settings(
                {STEPS: 1, GAP: 1e-10}, tied(3) if law == "tied" else rough(3, 0.4), enforcement, solver), n_ranks)
            forces = [result.force(pair)[d] for pair in NAMES[:3] for d in (0, 2)]
            first = first or forces
            below(f"{result}, forces", max(abs(f - g) for f, g in zip(forces, first)) / first[1], 1e-6)
            check(result.iterations() <= 15, f"{result}: {result.iterations()} iterations")
    # In several steps: the bases, strained beside each other, do not decide by who bulges more.
    result = run(f"joints_{joints}_steps", path, settings({STEPS: 4, GAP: 1e-10}, rough(3, 0.4)))
    forces = [result.force(pair)[d] for pair in NAMES[:3] for d in (0, 2)]
    below(f"{result}, forces", max(abs(f - g) for f, g in zip(forces, first)) / first[1], 1e-3)
    check(result.iterations() <= 30, f"{result}: {result.iterations()} iterations")

# Pointwise rows tie meshes 6 : 4, with the coarse side as slave 4 : 8; ties that are exact.
LOWER, UPPER = "Body lower/Geometry/Cells", "Body upper/Geometry/Cells"
for k, (change, uneven) in enumerate((({}, True), ({LOWER: "4, 4, 2", UPPER: "8, 8, 2"}, True),
                                      ({LOWER: "4, 4, 2"}, False), ({LOWER: "8, 8, 3"}, False),
                                      ({"Contact pair interface/Pairing": "averaged"}, False))):
    result = run(f"uneven_{k}", tests / "tied_non_matching.prm", change, ranks=1 + (k == 0))
    found = any("the meshes do not match" in text for text in result.summary["warnings"])
    check(found == uneven, f"{result}: warnings {result.summary['warnings']}")
finish()
