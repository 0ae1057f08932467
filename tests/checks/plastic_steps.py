# SPDX-License-Identifier: LGPL-2.1-or-later
"""A ball is pressed into a plastic block, in steps of the right size, in ten times too large ones,
and in a single one: the same result but for the error of large steps, never garbage. On two ranks
and with conjugate gradients the same."""

from touchstone_test import CG, RESIDUAL, STEPS, below, check, checks, finish, run, same

SHARP = {RESIDUAL: 1e-11}
PLASTICITY = "Body block/Material/Plasticity"
UNSYMMETRIC = {**SHARP, f"{PLASTICITY}/Kinematic modulus": 30, f"{PLASTICITY}/Kinematic recovery": 10}


def press(name, settings, ranks=1, vtu=0):
    return run(name, checks / "plastic_steps.prm", settings, ranks, vtu=vtu)


right = press("right", SHARP)
same(right, press("ranks", SHARP, 2), 1e-7)
same(right, press("cg", {**SHARP, **CG}), 1e-6)

# Without cuts, or with: the steps that remain differ.
same(right, press("two", {STEPS: 2}), 0.1)
one = press("one", {STEPS: 1}, vtu=1)
same(right, one, 0.3)
# VTU files show the plastic strain.
check("equivalent_plastic_strain" in
      (one.folder / "solution_0001.vtu").read_text(encoding="utf-8", errors="replace"),
      "no plastic strain in VTU files")

# Unsymmetric tangent.
unsymmetric = press("unsymmetric", UNSYMMETRIC)
same(unsymmetric, press("both", UNSYMMETRIC, 2), 1e-7)
same(unsymmetric, press("lagged", {**UNSYMMETRIC, **CG}), 1e-6)
below("unsymmetric, Newton iterations a step, 20 times", unsymmetric.iterations(), 180)
finish()
