# SPDX-License-Identifier: LGPL-2.1-or-later
"""Estimated errors of contact forces against the true ones (doc/theory.md, section 11, equation (32)):
press fits, whose exact force is known, with facets, other meshes on the other side and either
pairing, in three tubes, or with springs, and a ball on a rigid plane, whose force is extrapolated
from two meshes. What cannot be estimated is not 0."""

import math

from touchstone_test import CG, DEGREE, FACTOR, check, checks, finish, prm, relative, run, tests

FORCE = {"Refinement/Estimator": "contact force", "Refinement/Cycles": 0}
# Lame's tubes, plane strain: force per angle and length, theory.md, section 10.
E, NU, CORE, SKIN, BORE, OUTER, LENGTH = 210000, 0.3, 0.5, 1.001, 1.0, 1.5, 0.25


def compliance(a, b, sign):
    return ((1 - NU ** 2) * (b * b + a * a) / (b * b - a * a) + sign * NU * (1 + NU)) / E


PRESS_FIT = math.sqrt(2) * LENGTH * (SKIN - BORE) / (
    compliance(CORE, SKIN, -1) + compliance(BORE, OUTER, 1))


def judge(result, pair, exact):
    """The estimate is half to twice the true error, with its sign."""
    force = math.hypot(*result.force(pair))
    estimate, error = result.contact(pair, "estimated_force_error"), force / exact - 1
    print(f"{result}: force off by {error:.2e}, estimated {estimate:.2e}, "
          f"effectivity {estimate / error:.2f}", flush=True)
    check(0.5 < estimate / error < 2, f"{result}: the estimate is {estimate / error:.2f} times the error")
    return estimate


def press_fit(name, inner, outer, pairing="averaged", ranks=1, degree=1):
    return judge(run(f"press_fit_{name}", prm / "press_fit.prm",
                     {"Body inner tube/Geometry/Cells": inner, DEGREE: degree,
                      "Body outer tube/Geometry/Cells": outer, "Contact pair fit/Pairing": pairing,
                      **FORCE}, ranks), "fit", PRESS_FIT)


press_fit("12", "4, 12, 1", "4, 12, 1")
one = press_fit("24", "8, 24, 2", "8, 24, 2")
press_fit("24_pointwise", "8, 24, 2", "8, 24, 2", "pointwise")
press_fit("18_24", "6, 18, 1", "8, 24, 1")
two = press_fit("24_ranks", "8, 24, 2", "8, 24, 2", ranks=2)
check(relative(two, one) < 1e-6, f"two ranks estimate {two}, one {one}")
# Degree 2 converges with the fourth power of the cell size: stresses are recovered by quadratic fits.
one = press_fit("quadratic_12", "4, 12, 1", "4, 12, 1", degree=2)
press_fit("quadratic_24", "8, 24, 1", "8, 24, 1", degree=2)
press_fit("quadratic_9_12", "3, 9, 1", "4, 12, 1", degree=2)
two = press_fit("quadratic_12_ranks", "4, 12, 1", "4, 12, 1", ranks=2, degree=2)
check(relative(two, one) < 1e-6, f"two ranks estimate {two}, one {one}")

# The error falls with the square of the cell size.
planes = [run(f"plane_{factor}", prm / "hertz_rigid_plane.prm", {FACTOR: factor, **FORCE})
          for factor in (0.5, 1)]
coarse, fine = (math.hypot(*plane.force("contact")) for plane in planes)
# An iterative solver finds the response to the motion of the supports as well as Newton's increments.
iterated = run("plane_iterated", prm / "hertz_rigid_plane.prm", {FACTOR: 0.5, **FORCE, **CG})
one, two = (result.contact("contact", "estimated_force_error") for result in (planes[0], iterated))
check(relative(two, one) < 1e-3, f"conjugate gradients estimate {two}, MUMPS {one}")
for plane in planes:
    judge(plane, "contact", fine - (coarse - fine) / 3)

# With friction, where no supports of both sides meet at the edge of the contact.
RUBBED = {"Contact pair contact/Behaviour": "coulomb", "Contact pair contact/Friction/Coefficient": 0.3}
planes = [run(f"rubbed_plane_{factor}", prm / "hertz_rigid_plane.prm", {FACTOR: factor, **FORCE, **RUBBED})
          for factor in (0.5, 1)]
coarse, fine = (math.hypot(*plane.force("contact")) for plane in planes)
for plane in planes:
    judge(plane, "contact", fine - (coarse - fine) / 3)

# Three tubes: what moves the force of a pair are the supports of all tubes on its side. On a mesh
# that stays, any partitioner will do.
tubes = {n: run(f"tubes_{n}", checks / "three_tubes.prm",
                {f"Body {body}/Geometry/Cells": f"{n // 3}, {n}, 1" for body in ("core", "middle", "jacket")})
         for n in (12, 24)}
pressure = (SKIN - BORE) / (compliance(CORE, SKIN, -1) + compliance(BORE, 2 * BORE, 1))
for tube in tubes.values():
    judge(tube, "fit", math.sqrt(2) * LENGTH * pressure)
    judge(tube, "joint", math.sqrt(2) * LENGTH * pressure * OUTER * (4 / OUTER ** 2 - 1) / 3)
other = run("tubes_ranks", checks / "three_tubes.prm", {"Discretisation/Partitioner": "coordinates"}, ranks=2)
one, two = (result.contact("fit", "estimated_force_error") for result in (tubes[12], other))
check(relative(two, one) < 1e-6, f"two ranks with another partitioner estimate {two}, one {one}")

# Springs hold the outer tube along its first cut: their ground moves with the other supports.
bedded = [run(f"bedded_{n}", prm / "press_fit.prm",
              {"Body outer tube/Symmetry": "second cut, start, end",
               "Body outer tube/Boundary conditions": "first cut",
               "Body outer tube/Boundary first cut/Spring stiffness normal": 3e5,
               "Body inner tube/Geometry/Cells": f"{n // 3}, {n}, 1",
               "Body outer tube/Geometry/Cells": f"{n // 3}, {n}, 1", **FORCE}) for n in (12, 24)]
coarse, fine = (math.hypot(*result.force("fit")) for result in bedded)
for result in bedded:
    judge(result, "fit", fine + (fine - coarse) / 3)

# With friction it is said that the estimate leaves a part out.
rubbed = run("rubbed", prm / "press_fit.prm", {"Contact pair fit/Behaviour": "coulomb",
                                               "Contact pair fit/Friction/Coefficient": 0.3, **FORCE})
rubbed.says("leave out what the mesh makes of friction")


def has_none(result, pair, mesh=0):
    """No estimate on a mesh: null, and a warning, also in summary.json."""
    check(result.summary["meshes"][mesh]["estimated_error"] is None, f"{result}: an estimate of a mesh that has none")
    check(any(f"'{pair}' is not estimated" in text for text in result.summary["warnings"]),
          f"{result}: no warning of pair {pair}")


# A bolt may be looked at as it is: there is no estimate while it is tightened, then the same on
# both sides of its head.
tight = run("tight", tests / "bolted_pretension.prm", {**FORCE, "Refinement/Cycles per step": 0})
has_none(tight, "cut", 1)
csv = [line.split(",") for line in (tight.folder / "statistics.csv").read_text(encoding="utf-8").splitlines()]
cut, head = (csv[0].index(f"{pair}.estimated_force_error") for pair in ("cut", "head"))
check(all(row[cut] == "" for row in csv[1:4]), f"tight: no empty cells in {csv[1:4]}")
for row in csv[4:]:
    check(0 < float(row[cut]) < 0.2 and relative(float(row[cut]), float(row[head])) < 1e-6,
          f"tight: errors {row[cut]} of the cut, {row[head]} of the head")
# Between obstacles no support carries the force: the tolerance is not reached.
between = run("between", checks / "between_obstacles.prm")
has_none(between, "above")
check(len(between.summary["meshes"]) == 2, "between: the tolerance ended refinement without an estimate")
# Nor does a region have an estimate.
region = run("region", prm / "press_fit.prm", {"Refinement/Estimator": "region", "Refinement/Region": "0.9 - x",
                                               "Refinement/Cycles": 1, "Refinement/Tolerance": 0.9})
check([mesh["estimated_error"] for mesh in region.summary["meshes"]] == [None, None],
      f"region: {region.summary['meshes']}")
finish()
