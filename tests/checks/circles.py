# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pairs whose surfaces are slave and master of each other in a cycle pass the patch test, on
matching and non-matching meshes, with forces in balance, on one and two ranks; and the rows that
say the same thing twice are dropped and reported. Where bodies bend, normals tilt and couple all
pairs, by little: all enforcements keep all rows and agree, in statics and in dynamics."""

import re

from touchstone_test import (AUGMENTED, ENFORCEMENT, ENFORCEMENTS, GAP, STEPS, below, check, checks,
                             finish, relative, run, same)

MATCHING = {"Body upper/Geometry/Cells": "6, 6, 3"}


def dropped(result):
    """How many rows the run says that it has dropped."""
    found = re.findall(r"(\d+) contact row\(s\) dropped", result.log)
    return int(found[-1]) if found else 0


def passes(result):
    below(f"{result}, stress_max_deviation", result.error("stress_max_deviation"), 1e-9)
    return result


def two_pass(name, enforcement, nodes, settings=None, ranks=1):
    result = passes(run(name, checks / "two_pass.prm",
                        {ENFORCEMENT: enforcement, **(settings or {})}, ranks))
    # Both pairs together carry the load.
    below(f"{name}, force out of balance",
          relative(result.force("back")[2] - result.force("interface")[2], 10), 1e-9)
    # All rows of the second pair; springs need not be dropped.
    expected = 0 if enforcement == "penalty" else nodes
    check(dropped(result) == expected,
          f"{name}: {dropped(result)} rows dropped and reported, expected {expected}")
    return result


def ring(name, enforcement, ranks=1):
    # What gap an augmented Lagrangian leaves is an error of the stress, of E times that.
    gap = {GAP: 1e-12} if enforcement == AUGMENTED[ENFORCEMENT] else {}
    result = run(name, checks / "ring.prm", {ENFORCEMENT: enforcement, **gap}, ranks)
    if enforcement != "penalty":
        passes(result)
    below(f"{name}, weight out of balance",
          relative(result.reaction("base", "bottom")[2], 20), 1e-9)
    return result


def bent_ring(name, enforcement, settings, ranks=1):
    """The ring under a load that is not uniform."""
    result = run(name, checks / "ring.prm",
                 {ENFORCEMENT: enforcement, "Body left/Boundary top/Pressure": "6*t*(1 + x)",
                  GAP: 1e-12, **settings}, ranks)
    check(dropped(result) == 0, f"{name}: rows were dropped")
    return result


# Elimination once dropped eight rows here: a body came into another by 5 % of a face.
DYNAMIC = {"Time integration/Scheme": "newmark", STEPS: 5,
           **{f"Body {body}/Material/Density": 30 for body in ("base", "left", "right")}}
for kind, settings in (("bent", {}), ("shaken", DYNAMIC)):
    eliminated = bent_ring(f"{kind}_elimination", "elimination", settings)
    for other in "lagrange multipliers", "augmented lagrange":
        same(eliminated, bent_ring(f"{kind}_{other}", other, settings), 1e-7)
    same(eliminated, bent_ring(f"{kind}_2", "elimination", settings, 2), 1e-8)
    same(eliminated, bent_ring(f"{kind}_GMRES", "elimination",
                               {**settings, "Linear solver/Type": "Belos GMRES"}), 1e-7)

# A patch test of three bodies around an edge; exact formulations once dropped two rows there, and the
# third body was 38 % off.
for enforcement in ENFORCEMENTS:
    star = run(f"star_{enforcement}", checks / "star.prm", {ENFORCEMENT: enforcement, GAP: 1e-10})
    check(dropped(star) == 0, f"{star}: rows were dropped")
    bound = 0.02 if enforcement == "penalty" else 1e-7
    for kind in "displacement_l2", "pressure_l2":
        below(f"{star}, {kind}", star.error(kind), bound)

for enforcement in ENFORCEMENTS:
    two_ranks = enforcement in ("elimination", "lagrange multipliers")
    non_matching = two_pass(f"non_matching_{enforcement}", enforcement, 25)
    three = ring(f"ring_{enforcement}", enforcement)
    if two_ranks:
        same(non_matching, two_pass(f"non_matching_{enforcement}_2", enforcement, 25, ranks=2), 1e-8)
        same(three, ring(f"ring_{enforcement}_2", enforcement, 2), 1e-8)
same(two_pass("matching", "elimination", 49, MATCHING),
     two_pass("matching_2", "elimination", 49, MATCHING, 2), 1e-8)
finish()
