# SPDX-License-Identifier: LGPL-2.1-or-later
"""Averaged rows pass the patch test with every enforcement, both slave choices, both degrees, flat
(inclined: inclined_patch.py), nearly incompressible, on one and two ranks; and are as good on
curved surfaces."""

from touchstone_test import (AUGMENTED, CG, DEGREE, ENFORCEMENT, ENFORCEMENTS, MULTIPLIERS, PENALTY,
                             RESIDUAL, STEPS, below, check, finish, prm, relative, run)

PAIR = "Contact pair interface"
AVERAGED = {f"{PAIR}/Pairing": "averaged"}
COARSE_SLAVE = {f"{PAIR}/Slave body": "upper", f"{PAIR}/Slave boundaries": "bottom",
                f"{PAIR}/Master body": "lower", f"{PAIR}/Master boundaries": "top"}


def patch(name, settings=None, ranks=1):
    result = run(name, prm / "patch_test.prm", {**AVERAGED, **(settings or {})}, ranks)
    below(f"{name}, stress_max_deviation", result.error("stress_max_deviation"), 1e-10)


for enforcement in ENFORCEMENTS:
    patch(f"fine_{enforcement}", {ENFORCEMENT: enforcement})
patch("coarse", COARSE_SLAVE, 2)
patch("coarse_penalty", {**COARSE_SLAVE, **PENALTY}, 2)
patch("outer_augmentation", {**AUGMENTED, "Contact/Augmentation": "outer"})
patch("degree_2", {DEGREE: 2})
patch("nearly_incompressible", {"Body lower/Element": "b-bar", "Body upper/Element": "b-bar",
                                "Body lower/Material/Poisson ratio": 0.4999,
                                "Body upper/Material/Poisson ratio": 0.4999}, 2)
patch("belos", {**CG, "Linear solver/Tolerance": 1e-8, RESIDUAL: 1e-13}, 2)
patch("smoothed", {f"{PAIR}/Contact geometry": "faceted", f"{PAIR}/Master normal": "smoothed"}, 2)

# Pointwise rows must not pass, or the test shows nothing.
pointwise = run("pointwise", prm / "patch_test.prm", {f"{PAIR}/Pairing": "pointwise"})
check(pointwise.error("stress_max_deviation") > 0.1, "pointwise rows pass the patch test")


def fit(name, coarse, mean, deviation, settings=None):
    """Meshes 4:3 of the press fit with either slave: bounds for the mean and for the largest
    deviation of a node."""
    result = run(name, prm / "press_fit.prm",
                 {"Contact pair fit/Pairing": "averaged",
                  "Body inner tube/Geometry/Cells": "8, 48, 3",
                  "Body outer tube/Geometry/Cells": "8, 48, 3",
                  f"Body {coarse} tube/Geometry/Cells": "8, 36, 3", **(settings or {})})
    below(f"{name}, mean", result.error("contact_pressure_mean"), mean)
    below(f"{name}, deviation", result.error("contact_pressure_max_deviation"), deviation)


SMOOTHED = {"Contact pair fit/Contact geometry": "faceted",
            "Contact pair fit/Master normal": "smoothed"}
for coarse in "inner", "outer":
    fit(f"fit_{coarse}", coarse, 1e-3, 2e-2)
    # From facets, with both sides smoothed: without, the overlap of 1e-3 drowns.
    fit(f"fit_smoothed_{coarse}", coarse, 1e-2, 5e-2, SMOOTHED)
fit("fit_multipliers", "outer", 1e-3, 2e-2, MULTIPLIERS)
fit("fit_augmented", "inner", 1e-3, 2e-2, AUGMENTED)

# The insertion: enforcements agree to 1e-6 (ranks and multipliers: agreement.py), the penalty to
# 1e-2. With slave and master swapped the push force changes by less than 1 %, where pointwise rows
# allow 10 %.
CONE = "Contact pair cone"
SWAPPED = {f"{CONE}/Slave body": "inner tube", f"{CONE}/Slave boundaries": "outer",
           f"{CONE}/Master body": "outer tube", f"{CONE}/Master boundaries": "inner"}
FACETED = {f"{CONE}/Contact geometry": "faceted", f"{CONE}/Master normal": "smoothed"}


def push(name, settings=None, ranks=1):
    result = run(name, prm / "two_tubes.prm",
                 {STEPS: 1, f"{CONE}/Pairing": "averaged", **(settings or {})}, ranks)
    return result.reaction("inner tube", "end")[0]


tubes = push("tubes")
# To which refinement tends.
below("tubes, push force differs from 33.5", relative(tubes, -33.5), 0.01)
below("augmented Lagrange differs", relative(push("augmented", {**AUGMENTED, **CG}), tubes), 1e-6)
below("penalty differs", relative(push("penalty", PENALTY), tubes), 1e-2)
below("swapped differs", relative(push("swapped", SWAPPED), tubes), 1e-2)
smoothed = push("smoothed", FACETED)
below("smoothed differs from the exact surfaces", relative(smoothed, tubes), 1e-2)
below("smoothed and swapped differs",
      relative(push("smoothed_swapped", {**FACETED, **SWAPPED}, 2), smoothed), 1e-2)
finish()
