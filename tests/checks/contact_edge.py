# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hertz contact on meshes that follow the edge of the contact: the error of the pressure field falls
with the mesh, and the estimated error of the contact force is that of the force."""

from touchstone_test import (FACTOR, MULTIPLIERS, PENALTY, below, check, finish, prm, relative, run,
                             same, tests)

SCENE = prm / "benchmarks/hertz_rings.prm"


def rings(name, constants, settings=None, ranks=1):
    return run(name, SCENE, {"Constants": constants, **(settings or {})}, ranks)


# The rings in place of e = 0.1003 are those of contrib/record_table.sh.
coarse = rings("coarse", "n = 4, h = 0.002, s = 0.015, c = 0.03")
fine = rings("fine", "n = 6, h = 0.001, s = 0.008, c = 0.03")
for result, bound in (coarse, 0.012), (fine, 0.006):
    below(f"{result}, pressure_field_l2", result.error("pressure_field_l2"), bound)
same(coarse, rings("ranks", "n = 4, h = 0.002, s = 0.015, c = 0.03", ranks=2), 1e-5)

# The force to which the forces of meshes of 756 to 215,000 nodes extrapolate: from factors 1 and 2
# with an error that falls with the square of the cell size; factor 0.5 agrees with that to 3e-4.
EXACT = 1.5343 / 4
for factor in 0.5, 1:
    estimated = rings(f"estimate_{factor}", "e = 0.1, n = 4, s = 0.02, h = 0.004, o = 1.6, c = 0.03",
                      {FACTOR: factor, "Linear solver/Preconditioner": "ML",
                       "Refinement/Estimator": "contact force", "Refinement/Cycles": 0})
    force = estimated.force("contact")[2]
    estimate = estimated.contact("contact", "estimated_force_error")
    effectivity = estimate / (force / EXACT - 1)
    check(0.5 < effectivity < 2, f"factor {factor}: the estimate is {effectivity:.2f} times the error")

# All enforcements and ranks estimate alike, and the estimate ends refinement.
FORCE = {"Refinement/Estimator": "contact force", "Refinement/Cycles": 0}
elimination, *others = [run(name, tests / "hertz_sphere.prm", {**FORCE, **settings}, ranks)
                        for name, settings, ranks in (("elimination", {}, 1), ("two_ranks", {}, 2),
                                                      ("multipliers", MULTIPLIERS, 1),
                                                      ("penalty", PENALTY, 1))]


def exact_force(result):
    """As estimated: the error of a penalty is part of the estimate."""
    return result.force("contact")[2] / (1 + result.contact("contact", "estimated_force_error"))


for other in others:
    below("estimates apart", relative(exact_force(other), exact_force(elimination)), 1e-3)
below("estimates on two ranks apart",
      relative(*(result.contact("contact", "estimated_force_error")
                 for result in (others[0], elimination))), 1e-6)
adaptive = run("adaptive", prm / "hertz_sphere_adaptive.prm",
               {**FORCE, "Refinement/Cycles": 6, "Refinement/Contact fraction": 0.3,
                "Refinement/Tolerance": 0.02})
errors = [mesh["estimated_error"] for mesh in adaptive.summary["meshes"]]
check(len(errors) > 1 and min(errors[:-1]) >= 0.02 > errors[-1],
      f"refinement did not end with the estimate: {errors}")
finish()
