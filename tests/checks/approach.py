# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nodes that touch within a step. The relative displacement of their approach is no slip, so that a
block that comes down askew on a corner finds the friction of small steps with large ones. The
force along x, friction alone, is 0.567 with 64 steps; counted as slip, the approach makes it 0.43
with 6 steps, 0.47 with 8 and 0.54 with 32."""

from touchstone_test import AUGMENTED, MULTIPLIERS, STEPS, below, finish, relative, run, same, tests


def fall(name, steps, settings=None, ranks=1):
    return run(name, tests / "hard_corner.prm", {STEPS: steps, **(settings or {})}, ranks)


small = fall("small", 32)
for steps, bound in (6, 0.1), (8, 0.04), (16, 0.01):
    result = fall(f"steps_{steps}", steps)
    below(f"{steps} steps, force along x differs from that of 32 steps",
          relative(result.force("contact")[0], small.force("contact")[0]), bound)
    if steps == 8:
        eight = result
same(eight, fall("ranks", 8, ranks=2), 1e-6)
same(eight, fall("multipliers", 8, MULTIPLIERS), 1e-6)
same(eight, fall("augmented", 8, AUGMENTED), 1e-6)
finish()
