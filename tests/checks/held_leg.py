# SPDX-License-Identifier: LGPL-2.1-or-later
"""Friction of slave nodes that supports hold, on a master that is hardly able to follow them: all enforcements
and solvers have the force to which gaps are closed a hundred thousand times as far, in a few iterations, where the nodes stick
and where some slide by next to nothing."""
# ctest: label = quick

from touchstone_test import below, check, checks, finish, relative, run

SCENE, TYPE, GAPS = checks / "held_leg.prm", "Linear solver/Type", "Newton/Gap tolerance"
WAYS = {"multipliers": ({"Contact/Enforcement": "lagrange multipliers"}, 1),
        "augmented": ({"Contact/Enforcement": "augmented lagrange"}, 1),
        "gmres": ({TYPE: "Belos GMRES"}, 1), "ranks": ({}, 2)}


def across(result):
    return result.reaction("leg", "right")[0]


# Before: 6e-5 off with up to 26 iterations a step, and no convergence by augmented Lagrange. In the second scene the nodes
# at the corners slide by 1e-5 of a face.
for name, settings in ("stick", {}), ("slip", {"Contact pair foot/Friction/Coefficient": 0.3}):
    exact = across(run(f"{name}_exact", SCENE, {TYPE: "MUMPS", GAPS: 1e-13, **settings}))
    for way, (choice, ranks) in {"elimination": ({}, 1), **WAYS}.items():
        result = run(f"{name}_{way}", SCENE, {TYPE: "MUMPS", **settings, **choice}, ranks=ranks)
        below(f"{result}, force across is off", relative(across(result), exact), 1e-7)
        check(result.iterations() <= 100, f"{result}: {result.iterations()} Newton iterations in 8 steps")
finish()
