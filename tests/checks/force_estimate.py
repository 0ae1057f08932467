# SPDX-License-Identifier: LGPL-2.1-or-later
"""Estimated errors of contact forces against the true ones (doc/theory.md, section 11, equation (32)):
press fits, whose exact force is known, with facets, other meshes on the other side and either
pairing, and a ball on a rigid plane, whose force is extrapolated from two meshes."""

import math

from touchstone_test import CG, DEGREE, FACTOR, check, finish, prm, relative, run, tests

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
# With friction it is said that the estimate leaves a part out; a bolt with pretension may be looked at as it is.
rubbed = run("rubbed", prm / "press_fit.prm", {"Contact pair fit/Behaviour": "coulomb",
                                               "Contact pair fit/Friction/Coefficient": 0.3, **FORCE})
rubbed.says("leave out what the mesh makes of friction")
tight = run("tight", tests / "bolted_pretension.prm", {**FORCE, "Refinement/Cycles per step": 0})
check(0 < abs(tight.contact("cut", "estimated_force_error")) < 1, f"{tight}: no estimate of the tension")
finish()
