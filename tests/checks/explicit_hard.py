# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hard cases of contact in explicit dynamics: each ends right, or with the reason (table in
doc/explicit.md, section 9.9)."""

import math

from touchstone_test import below, check, checks, contact_gives, finish, folder, launch, relative, run


def vector(values):
    """Numbers or formulas with commas."""
    return ", ".join(str(value) for value in values)


def block(name, lower, upper, cells, velocity=(0, 0, 0), stiffness=1000, density=1, poisson=0.3,
          law="neo-Hookean", more="", force=("", "", "")):
    """The section of a box."""
    lines = [f"subsection Body {name}", "  set Element = one point", more]
    lines += [f"  set Initial velocity {axis} = {v}" for axis, v in zip("xyz", velocity)]
    lines += [f"  set Body force {axis} = {f}" for axis, f in zip("xyz", force)]
    lines += ["  subsection Geometry", "    set Type = box",
              f"    set Lower corner = {vector(lower)}", f"    set Upper corner = {vector(upper)}",
              f"    set Cells = {vector(cells)}", "  end", "  subsection Material",
              f"    set Law = {law}", f"    set Young modulus = {stiffness}",
              f"    set Poisson ratio = {poisson}", f"    set Density = {density}", "  end", "end"]
    return "\n".join(lines)


def plane(name, point, direction, motion=("", "", "")):
    """The section of a plane."""
    return "\n".join([f"subsection Obstacle {name}", "  set Shape = plane",
                      f"  set Point = {vector(point)}", f"  set Direction = {vector(direction)}"] +
                     [f"  set Motion {axis} = {m}" for axis, m in zip("xyz", motion) if m] +
                     ["end"])


def corners(section, points, more=""):
    """The section of a box as a block with these corners."""
    start, end = section.index("    set Type = box"), section.index("    set Cells")
    return (section[:start] + "    set Type = block\n    set Corners = " +
            "; ".join(map(vector, points)) + "\n" + more + section[end:])


ALL = "left, right, front, back, bottom, top"


def pair(name, slave, sides, master="", master_sides="", obstacle="", friction=None, more=""):
    """The section of a contact pair."""
    lines = [f"subsection Contact pair {name}", f"  set Slave body = {slave}",
             f"  set Slave boundaries = {sides}"]
    if obstacle:
        lines.append(f"  set Obstacle = {obstacle}")
    else:
        lines += [f"  set Master body = {master}", f"  set Master boundaries = {master_sides}"]
    if friction is not None:
        lines += ["  set Behaviour = coulomb", "  subsection Friction",
                  f"    set Coefficient = {friction}", "  end"]
    return "\n".join([*lines, more, "end"])


def hard(name, parts, end, steps=10, ranks=1, fails=False, settings=None, within=1e-3,
         balance=5e-3):
    """Write the scene, run it, and look at what every run must keep."""
    def names(kind):
        return ", ".join(part.split("\n", 1)[0][len(f"subsection {kind} "):] for part in parts
                         if part.startswith(f"subsection {kind} "))
    heads = [f"set {key} = {names(kind)}" for key, kind in
             (("Bodies", "Body"), ("Obstacles", "Obstacle"), ("Contact pairs", "Contact pair"))
             if names(kind)]
    times = ["subsection Time integration", "  set Scheme = central_differences",
             "  set Linear bulk viscosity = 0", "  set Quadratic bulk viscosity = 0", "end",
             "subsection Load stepping", f"  set End time = {end}", f"  set Steps = {steps}", "end"]
    (folder / f"{name}.prm").write_text("\n".join([*heads, *parts, *times, ""]), encoding="utf-8")
    result = run(name, folder / f"{name}.prm", settings, ranks, fails)
    if not fails and result.summary:
        energies = result.summary["motion"]["energies"]
        size = max(energies["initial"], abs(energies["external"]), energies["kinetic"])
        below(f"{name}, balance error", abs(energies["balance_error"]) / size, balance)
        contact_gives(result, 1e-11)
        for title in result.rows()[0]:
            if title.endswith("max penetration"):
                below(f"{name}, {title}", max(result.column(title)), within)
    return result


def momentum_kept(result):
    """Linear momentum, of bodies that nothing else acts on."""
    for axis in "xyz":
        values = result.column(f"momentum {axis}")
        below(f"{result}, momentum {axis}", max(values) - min(values), 1e-11)


def pressed(result, name="pair"):
    """There was contact."""
    check(max(result.column(f"{name}: active nodes")) > 0, f"{result}: no contact")


BASE = block("base", (0, 0, -1), (2, 2, 0), (2, 2, 1))


def on_base(name, lower, cells=(1, 1, 1), speed=-1, size=1, settings=None, friction=None, end=0.2,
            sideways=0):
    """A block that falls on the middle of a base."""
    upper = [x + size for x in lower]
    result = hard(name, [BASE, block("block", lower, upper, cells, (sideways, 0, speed)),
                         pair("pair", "block", "bottom", "base", "top", friction=friction)],
                  end, settings=settings)
    pressed(result)
    momentum_kept(result)
    return result


# 2 coincident nodes, 3 nodes on edges, 4 nodes on vertices of the other mesh; 6, 16: faces in a plane, single cells.
on_base("coincident", (0, 0, 0.01))
on_base("on_edges", (0.5, 0, 0.01))
on_base("on_vertices", (0.5, 0.5, 0.01), (2, 2, 1))
on_base("pointwise_vertices", (0.5, 0.5, 0.01), (2, 2, 1),
        settings={"Contact pair pair/Pairing": "pointwise"})
on_base("sliding_in_plane", (0.2, 0.5, 0), (3, 3, 1), -0.1, sideways=2, friction=0.3, end=0.3)
# 5 parallel edges: a block turned by 45 degrees falls with its edge on the edge between two cells (a wedge of
# one's own shape by the initial displacement), 7 nodes slide off a convex edge.
turned = ["(cos(pi/4)-1)*(x-1)-sin(pi/4)*(z-1)", "", "sin(pi/4)*(x-1)+(cos(pi/4)-1)*(z-1)"]
wedge = block("block", (0.5, 0.5, 0.5), (1.5, 1.5, 1.5), (2, 2, 2), (0, 0, -1), more="\n".join(
    f"  set Initial displacement {axis} = {formula}" for axis, formula in zip("xz", turned[::2])))
edge = hard("edge_on_edge", [block("base", (0, 0, -1), (2, 2, 0.29), (2, 2, 1)), wedge,
                             pair("pair", "block", "bottom, left", "base", "top")], 0.1)
pressed(edge)
momentum_kept(edge)
off = on_base("over_the_edge", (1.5, 0.5, 0), (2, 2, 2), -0.1, 0.8, end=0.5, sideways=4)
check(off.column("pair: active nodes")[-1] == 0, "over_the_edge: still in contact")
# 8 a concave edge: a block slides into the corner between floor and wall of deformable bodies.
concave = hard("concave", [BASE, block("wall", (2.001, 0, 0.001), (3, 2, 1), (1, 2, 1)),
                           block("block", (0.9, 0.4, 0.001), (1.9, 1.4, 1), (2, 2, 2), (2, 0, -1)),
                           pair("floor", "block", "bottom", "base", "top", friction=0.3),
                           pair("side", "block", "right", "wall", "left", friction=0.3)], 0.3)
for name in "floor", "side":
    pressed(concave, name)
momentum_kept(concave)
# 10 redundant rows: four walls, two of them the same, around a block that is as wide as their distance.
four = hard("four_walls", [block("block", (0, 0, 0), (1, 1, 1), (2, 2, 2), (1, 0.5, -1))] +
            [plane(n, p, d) for n, p, d in (("a", (0, 0, 0), (1, 0, 0)), ("b", (1, 0, 0), (-1, 0, 0)),
                                            ("c", (0, 0, 0), (0, 0, 1)), ("d", (0, 0, 0), (0, 0, 1)))] +
            [pair(f"p{n}", "block", side, obstacle=n) for n, side in
             (("a", "left"), ("b", "right"), ("c", "bottom"), ("d", "bottom"))], 0.3)
# 11, 32 squeezed between two planes that meet: crushed, with the place.
for law in "neo-Hookean", "linear elastic":
    crushed = hard(f"crushed_{law[:3]}", [
        block("block", (0, 0, 0), (1, 1, 1), (2, 2, 2), law=law), plane("low", (0, 0, 0), (0, 0, 1)),
        plane("high", (0, 0, 1), (0, 0, -1), ("", "", "-min(t, 1.1)")),
        pair("below", "block", "bottom", obstacle="low"), pair("above", "block", "top", obstacle="high")],
        1.2, fails=True)
    check("turned inside out" in crushed.text or "driven" in crushed.text or
          "no admissible" in crushed.text, f"crushed: the reason is not said:\n{crushed.text[-600:]}")
# 12 faces 1 : 1000, 13 cells 1 : 100.
sizes = hard("face_sizes", [block("base", (0, 0, -1), (100, 100, 0), (1, 1, 1), density=1e-4),
                            block("block", (50, 50, 0.001), (50.2, 50.2, 0.2), (2, 2, 2), (0.3, 0, -1)),
                            pair("pair", "block", "bottom", "base", "top", friction=0.3)], 0.03)
pressed(sizes)
aspect = hard("aspect", [BASE, block("block", (0.1, 0.1, 0.001), (1.9, 1.9, 0.019), (2, 2, 2), (0, 0, -1)),
                         pair("pair", "block", "bottom", "base", "top")], 0.02)
pressed(aspect)
momentum_kept(aspect)
# 14 ten times the speed of sound: the end has a reason.
fast = hard("fast", [BASE, block("block", (0.4, 0.4, 0.001), (1.4, 1.4, 1), (2, 2, 2), (0, 0, -300)),
                     pair("pair", "block", "bottom", "base", "top")], 0.05, fails=True)
check("turned inside out" in fast.text or "came from nowhere" in fast.text,
      f"fast: the reason is not said:\n{fast.text[-600:]}")
# 15 a tenth of a radian in a cycle.
spin = hard("spin", [BASE, block("block", (0.5, 0.5, 0.3), (1.5, 1.5, 1.3), (1, 1, 1),
                                 ("10*(z-0.8)", 0, "-10*(x-1)-1"), 1000),
                     pair("pair", "block", ALL, "base", "top", friction=0.3)], 0.2, within=0.01)
pressed(spin)
momentum_kept(spin)
# 17 mass, 18 stiffness 1 : 1e6.
for name, heavy, stiff in ("mass_ratio", 1e6, 1000), ("stiffness_ratio", 1, 1e9):
    ratio = hard(name, [block("base", (0, 0, -1), (2, 2, 0), (2, 2, 1), stiffness=stiff, density=heavy),
                        block("block", (0.3, 0.3, 0.001), (1.4, 1.4, 1), (2, 2, 2), (0, 0, -1)),
                        pair("pair", "block", "bottom", "base", "top", friction=0.3)],
                 0.2 if heavy > 1 else 0.01, balance=0.01)
    pressed(ratio)
# 19 ten blocks on each other under gravity, damped: each pair carries what is above.
stack = [block(f"b{n}", (0, 0, n), (1, 1, n + 1), (1, 1, 1), stiffness=1e4, force=("", "", "-min(1,t)"),
               law="linear elastic") for n in range(10)]
for n, text in enumerate(stack):
    stack[n] = text.replace("    set Density = 1\n", "    set Density = 1\n    set Rayleigh mass = 8\n")
piled = hard("stack", stack + [plane("ground", (0, 0, 0), (0, 0, 1)),
                               pair("p0", "b0", "bottom", obstacle="ground", friction=0.3)] +
             [pair(f"p{n}", f"b{n}", "bottom", f"b{n - 1}", "top", friction=0.3) for n in range(1, 10)],
             30, 10)
for n in range(10):
    below(f"stack, force {n}", abs(piled.force(f"p{n}")[2] / (10 - n) - 1), 1e-3)
# 20 an arch of stones under its own weight, dry joints with friction: it stands, carries its weight and thrusts
# against the ground on both sides alike. With too little friction it does not stand.
STONES, INNER, OUTER = 7, 0.8, 1.2


def stone(n):
    """The section of a stone, between two radii of the arch."""
    angles = [math.pi * k / STONES for k in (n, n + 1)]
    points = [(r * math.cos(a), 0, r * math.sin(a) if 0 < a < math.pi else 0)
              for r, a in zip((INNER, OUTER, OUTER, INNER), (angles[0], angles[0], angles[1], angles[1]))]
    text = block(f"s{n}", (0, 0, 0), (1, 1, 1), (2, 2, 1), stiffness=1e4, force=("", "", "-min(1,t)"))
    return corners(text.replace("    set Density = 1\n", "    set Density = 1\n    set Rayleigh mass = 8\n"),
                   points, "    set Extrusion = 0, -0.3, 0\n")


def arch(name, friction, fails=False):
    """The arch on a plane."""
    return hard(name, [stone(n) for n in range(STONES)] + [plane("ground", (0, 0, 0), (0, 0, 1))] +
                [pair("first", "s0", "front", obstacle="ground", friction=friction),
                 pair("last", f"s{STONES - 1}", "back", obstacle="ground", friction=friction)] +
                [pair(f"p{n}", f"s{n}", "front", f"s{n - 1}", "back", friction=friction)
                 for n in range(1, STONES)], 10, fails=fails)


stands = arch("arch", 0.6)
weight = 0.3 * STONES / 2 * math.sin(math.pi / STONES) * (OUTER**2 - INNER**2)
first, last = stands.force("first"), stands.force("last")
for name, force in ("first", first), ("last", last):
    below(f"arch, weight on the {name} stone", relative(force[2], weight / 2), 1e-3)
below("arch, thrust", relative(-first[0], last[0]), 1e-3)
check(0.1 * weight < last[0] < 0.6 * last[2], f"arch: thrust {last[0]} beside {last[2]}")
below("arch, velocity", abs(stands.column("energy: kinetic")[-1]) / weight, 1e-12)
falls = arch("falling_arch", 0.05, fails=True)
check("forces far from normal to the slave surface last" in falls.text,
      f"falling arch: the reason is not said:\n{falls.text[-600:]}")


# 21 a top on its point, 5 degrees from upright: it falls, but for spin. As the ground has no friction its angular
# momentum about the vertical axis stays.
def top(name, spin, end):
    """A pyramid upside down."""
    tilt = math.radians(5)
    sin, cos = math.sin(tilt), math.cos(tilt)
    text = block("top", (0, 0, 0), (1, 1, 1), (2, 2, 2), (f"-{spin}*y", f"{spin * cos}*x", f"{spin * sin}*x"),
                 1e5, force=("", "", "-10"), more="\n".join((
                     f"  set Initial displacement y = {cos - 1}*y - {sin}*z",
                     f"  set Initial displacement z = {sin}*y + {cos - 1}*z")))
    points = [(x * r, y * r, z) for r, z in ((0.03, 0.01), (0.5, 0.8))
              for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return hard(name, [corners(text, points), plane("ground", (0, 0, 0), (0, 0, 1)),
                       pair("pair", "top", "bottom", obstacle="ground")], end, 12)


spins, drops = top("top", 40, 1), top("falling_top", 0, 0.8)
moments = spins.column("angular momentum z")
below("top, angular momentum", max(abs(m / moments[0] - 1) for m in moments), 1e-12)
lost = [max(result.column("energy: external")) for result in (spins, drops)]
check(10 * lost[0] < lost[1], f"top: work of its weight {lost[0]}, without spin {lost[1]}")
# 22 a plate of one cell between two blocks that hit both its sides.
plate = hard("both_sides", [block("plate", (0, 0, 0), (2, 2, 0.02), (4, 4, 1)),
                            block("low", (0.5, 0.5, -1.001), (1.5, 1.5, -0.001), (2, 2, 2), (0, 0, 1)),
                            block("high", (0.4, 0.5, 0.021), (1.4, 1.5, 1.021), (3, 3, 2), (0, 0, -1)),
                            pair("below", "plate", "bottom", "low", "top"),
                            pair("above", "plate", "top", "high", "bottom")], 0.1)
for name in "below", "above":
    pressed(plate, name)
momentum_kept(plate)
# 25 a body a million widths away that comes back.
far = hard("far_away", [BASE, block("block", (0, 0, 0.01), (1, 1, 1), (2, 2, 2), (0, 0, -1)),
                        block("star", (1e6, 0, 0), (1e6 + 1, 1, 1), (1, 1, 1), (0, 1, 0)),
                        pair("pair", "block", "bottom", "base", "top"),
                        pair("never", "star", "left", "base", "right")], 0.1)
pressed(far)
# 29 a slave boundary that is fixed, beside one that is free.
fixed = hard("fixed_slave", [block("base", (0, 0, -1), (2, 2, 0), (2, 2, 1), more="  set Fixed = top"),
                             block("block", (0.3, 0.3, 0.01), (1.3, 1.3, 1), (2, 2, 2), (0, 0, -1)),
                             pair("pair", "base", "top", "block", "bottom")], 0.1, within=5e-3)
pressed(fixed)
# 30 a block on a ground that shakes leaves it and falls back again and again, 34 a block rubbed to and fro.
bounces = hard("bounces", [block("block", (0, 0, 0), (1, 1, 1), (1, 1, 1), stiffness=1e4, poisson=0,
                                 force=("", "", "-10")),
                           plane("ground", (0, 0, 0), (0, 0, 1), ("", "", "0.1*(1-cos(20*t))")),
                           pair("pair", "block", "bottom", obstacle="ground")], 120, 1200,
               settings={"Time integration/Courant factor": 0.5,
                         "Time integration/Linear bulk viscosity": 0.06,
                         "Body block/Material/Law": "linear elastic"})
opened = bounces.value("motion", "impacts", "pair", "openings")
check(opened > 100, f"bounces: only {opened} impacts")
rubbed = hard("rubbed", [block("block", (0, 0, 0), (1, 1, 1), (2, 2, 2), (0, 0, 0), 1e4,
                               force=("3*sin(500*t)", "", "-1")), plane("ground", (0, 0, 0), (0, 0, 1)),
                         pair("pair", "block", "bottom", obstacle="ground", friction=0.3)], 2)
work = rubbed.column("energy: friction")
check(all(b >= a - 1e-15 for a, b in zip(work, work[1:])), "rubbed: friction gives energy")

# Bad inputs that no scene of tests/refused has: section, key and remedy, before anything is computed.
SCENE = checks / "explicit_rolling.prm"
for setting in ("Body ball/Material/Density=0", "Body ball/Material/Density=-1", "Load stepping/Steps=0",
                "Load stepping/End time=0", "Time integration/Courant factor=0",
                "Time integration/Courant factor=nan", "Time integration/Step check interval=0",
                "Time integration/Linear bulk viscosity=-0.1",
                "Time integration/Quadratic bulk viscosity=inf",
                "Time integration/Mass scaling step=-1", "Time integration/Largest added mass=-1",
                "Contact/Contact tolerance=2", "Contact/Contact iterations=0",
                "Contact/Enforcement=elimination", "Body ball/Hourglass control=maybe",
                "Body ball/Hourglass coefficient=2", "Time integration/Stable step=fast",
                "Discretisation/Degree=2", "Body ball/Initial velocity x=sqrt(-1)",
                "Body ball/Body force z=1/(t-t)", "Contact pair contact/Friction/Coefficient=-1",
                "Time integration/Scheme=central differences", "Obstacle ground/Motion z=log(-1)",
                "Obstacle ground/Direction=0, 0, 0", "Time integration/Mass scaling step=1"):
    refused = launch("--results-only", "--output", "refused", "--set", setting, SCENE, timeout=60)
    section, key = setting.split("=")[0].rsplit("/", 1)
    if setting.startswith("Discretisation"):
        section, key = "Body ball", "Element"  # one point
    check(refused.returncode != 0 and all(text in refused.stdout for text in (
        f"Input error in section '{section}', key '{key}'", "Remedy: ")),
          f"{setting}: not refused, or without section, key and remedy:\n{refused.stdout[-400:]}")
finish()
