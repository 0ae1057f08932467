# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where there is another balance beside that of a scene, all solvers find the same one: points on the
edge between two faces of an exact surface that turn by different angles, a ball that rolls on one
node, and a leg that floats between what it touches, with forces that are round-off."""

from touchstone_test import below, check, checks, finish, run

TYPE = "Linear solver/Type"
OTHERS = {"gmres": ({TYPE: "Belos GMRES"}, 1), "cg": ({TYPE: "Belos CG"}, 1), "ranks": ({}, 2),
          "multipliers": ({"Contact/Enforcement": "lagrange multipliers"}, 1)}


def forces(result, pair):
    return [value for axis in "xyz" for value in result.column(f"{pair}: force {axis}")]


# Before: 1.5e-3, 8e-4 and 5e-4 apart, each with exit code 0.
for name, pair in ("point_on_crease", "contact"), ("tube_on_crease", "contact"), ("rolling_ball", "lowpair"):
    scene = checks / f"{name}.prm"
    one = run(name, scene, {TYPE: "MUMPS"})
    size = max(map(abs, forces(one, pair)))
    for other, (settings, ranks) in OTHERS.items():
        result = run(f"{name}_{other}", scene, {TYPE: "MUMPS", **settings}, ranks=ranks)
        check(len(result.column("time")) == len(one.column("time")), f"{result}: other steps than {one}")
        below(f"{result}, forces", max(abs(a - b) for a, b in zip(forces(result, pair), forces(one, pair))) / size, 1e-6)

# The scene has a plane of symmetry, y = 0. Which of two nodes carried round-off decided where points were placed: a force
# across it of 2.9e-4 of that along the leg (exit code 0).
for name, settings in ("legs", {}), ("legs_gmres", {TYPE: "Belos GMRES"}):
    legs = run(name, checks / "plate_on_legs_lifted.prm", settings)
    size = max(map(abs, forces(legs, "foot of right leg")))
    below(f"{legs}, across", max(map(abs, legs.column("foot of right leg: force y"))) / size, 1e-8)
finish()
