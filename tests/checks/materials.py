# SPDX-License-Identifier: LGPL-2.1-or-later
"""Viscoelastic relaxation against the Prony series: implicit steps, a restart, explicit dynamics;
thermal strain in explicit dynamics; rubber in tension against its formula; the locking stretch of
Gent's law ends the run."""
# ctest: goldens = prony_relaxation, prony_relaxation.mpirun=2, thermal_bars, thermal_bars.mpirun=2

import math

from touchstone_test import below, check, finish, golden, relative, run, same, tests


def force(time):
    """Exact force on the block of prony_relaxation.prm: a ramp until 0.5, then rest."""
    shear, bulk, ramp, strain = 3.6, 6, 0.5, -0.01
    sum_ = (bulk * (1 - 0.3) + 4 / 3 * shear * (1 - 0.7)) * strain
    for g, k, tau in ((0.3, 0.1, 0.5), (0.4, 0.2, 20)):
        modulus = k * bulk + 4 / 3 * g * shear
        sum_ += (modulus * strain / ramp * tau * (1 - math.exp(-ramp / tau)) *
                 math.exp(-(time - ramp) / tau))
    return sum_


relaxed = golden("prony_relaxation")
for time, value in zip(relaxed.column("time"), relaxed.column("block/top: reaction z")):
    if time > 0:
        below(f"force at {time}", relative(value, force(time)), 1e-9)
same(relaxed, golden("prony_relaxation", 2), 1e-9)
# Half of the time, then on from the checkpoint.
scene = tests / "prony_relaxation.prm"
run("resumed", scene, {"Checkpoints/Steps between": 5, "Load stepping/Steps": 10})
# Work of the support: what is not stored is dissipated.
work = relaxed.column("energy: strain")[-1] + relaxed.column("energy: material dissipation")[-1]
shear, bulk, x = 3.6, 6, 0.5
given = 0.5 * (bulk * 0.7 + 4 / 3 * shear * 0.3) * 0.01**2
for g, k, tau in ((0.3, 0.1, 0.5), (0.4, 0.2, 20)):
    modulus, x = k * bulk + 4 / 3 * g * shear, 0.5 / tau
    given += modulus * 0.01**2 * (x - 1 + math.exp(-x)) / x**2
below("energy stored and dissipated", relative(work, given), 1e-9)

slow = {"Time integration/Scheme": "central_differences", "Body block/Material/Density": 1e-4,
        "Body block/Material/Rayleigh mass": 200, "Body block/Geometry/Cells": "1,1,1"}
for element in "automatic", "one point":
    moved = run("explicit", scene, {**slow, "Body block/Element": element})
    # Of an interval the mean is written; by Simpson's rule.
    mean = (force(4.5) + 4 * force(4.75) + force(5)) / 6
    below(f"explicit force, {element}",
          relative(moved.column("block/top: reaction z")[-1], mean), 1e-4)

heated = golden("thermal_bars")
below("held bar", relative(heated.reaction("held", "right")[0], -2), 1e-8)
below("free bar", heated.error("displacement_l2"), 1e-10)
same(heated, golden("thermal_bars", 2), 1e-9)
bars = tests / "thermal_bars.prm"
moved = run("heated", bars, {"Time integration/Scheme": "central_differences",
                             **{f"Body {body}/Material/{key}": value for body in ("free", "held")
                                for key, value in (("Density", 1e-4), ("Rayleigh mass", 100))}})
# The force of an interval is its mean: of a temperature that grows evenly that at its middle.
below("explicit held bar", relative(moved.reaction("held", "right")[0], -1.5), 1e-3)
energies = moved.summary["motion"]["energies"]
below("ledger of heated bars", abs(energies["balance_error"]) / energies["strain"], 1e-3)
finish()
