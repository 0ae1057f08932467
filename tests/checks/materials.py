# SPDX-License-Identifier: LGPL-2.1-or-later
"""Viscoelastic relaxation against the Prony series: implicit steps, a restart, explicit dynamics;
thermal strain in explicit dynamics; rubber in tension against its formula; the locking stretch of
Gent's law ends the run."""
# ctest: goldens = prony_relaxation, prony_relaxation.mpirun=2, thermal_bars, thermal_bars.mpirun=2

import math
import shutil

from touchstone_test import (below, check, finish, folder, golden, launch, relative, run, same,
                             tests)


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
# On from the checkpoint in the middle: history and temperatures are in it.
scene, bars = tests / "prony_relaxation.prm", tests / "thermal_bars.prm"
for name, path, between in ("prony", scene, 5), ("bars", bars, 1):
    run(name, path, {"Checkpoints/Steps between": between})
    shutil.rmtree(f"{name}/checkpoint_000002")
    done = launch("--results-only", "--resume", "--output", name, "--set",
                  f"Checkpoints/Steps between={between}", "--set", "Output/VTU interval=0", path)
    check(done.returncode == 0, f"{name} resumed: {done.stdout}")
    again = run(f"{name} again", path)
    check((again.folder / "statistics").read_text(encoding="utf-8") ==
          (folder / name / "statistics").read_text(encoding="utf-8"), f"{name}: other statistics")
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
moved = run("heated", bars, {"Time integration/Scheme": "central_differences",
                             **{f"Body {body}/Material/{key}": value for body in ("free", "held")
                                for key, value in (("Density", 1e-4), ("Rayleigh mass", 100))}})
# The force of an interval is its mean: of a temperature that grows evenly that at its middle.
below("explicit held bar", relative(moved.reaction("held", "right")[0], -1.5), 1e-3)
# Gent's law in tension, incompressible but for a little: the nominal stress of the formula; beyond
# the locking stretch there is no answer, and the run says so instead of going on.
rubber = {"Body block/Material/Law": "Gent", "Body block/Material/Shear modulus": 1,
          "Body block/Material/Locking stretch": 2, "Body block/Material/Poisson ratio": 0.49999,
          "Body block/Boundary top/Displacement z": "0.8*t", "Load stepping/Steps": 4}
text = "set Bodies = block\nsubsection Body block\n  set Symmetry = left, front, bottom\n" \
       "  set Boundary conditions = top\n  subsection Geometry\n    set Type = box\n  end\nend\n"
(folder / "gent.prm").write_text(text, encoding="utf-8")
gent = run("gent", "gent.prm", rubber)
limit, stretch = 4 + 2 / 2 - 3, 1.8
exact = (limit / (limit - (stretch**2 + 2 / stretch - 3))) * (stretch - 1 / stretch**2)
below("Gent's law in tension", relative(gent.reaction("block", "top")[2], exact), 1e-3)
# Simple shear of a cell, prescribed at all nodes, reaches the limit at the shear sqrt(2).
(folder / "shear.prm").write_text(
    text.replace("set Symmetry = left, front, bottom", "set Fixed = bottom"), encoding="utf-8")
del rubber["Body block/Boundary top/Displacement z"]
rubber.update({"Body block/Boundary top/Displacement y": 0, "Body block/Boundary top/Displacement z": 0,
               "Body block/Geometry/Cells": "1, 1, 1"})
sheared = run("sheared", "shear.prm", {**rubber, "Body block/Boundary top/Displacement x": "1.3*t"})
below("Gent's law in shear", relative(sheared.reaction("block", "top")[0],
                                      limit / (limit - 1.3**2) * 1.3), 1e-9)
locked = run("locked", "shear.prm", {**rubber, "Body block/Boundary top/Displacement x": "1.5*t",
                                     "Load stepping/Maximum cuts": 3}, fails=True)
check("beyond the limit of its law" in locked.text, f"locked: {locked.text}")
check("nan" not in locked.text.lower(), f"locked: {locked.text}")
ended = run("ended", "shear.prm",
            {**rubber, "Body block/Boundary top/Displacement x": "1.5*t",
             "Body block/Material/Density": 1e-4, "Body block/Material/Poisson ratio": 0.49,
             "Time integration/Scheme": "central_differences"}, fails=True)
check("law has no answer" in ended.text, f"ended: {ended.text}")

energies = moved.summary["motion"]["energies"]
below("ledger of heated bars", abs(energies["balance_error"]) / energies["strain"], 1e-9)
finish()
