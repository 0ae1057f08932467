# SPDX-License-Identifier: LGPL-2.1-or-later
"""Augmented Lagrange goes the way of the multipliers where it is merged with Newton's iterations:
on curved and warped surfaces, over edges, with friction and near incompressibility it finds what
elimination finds, without a cut step and in about as many iterations."""
# ctest: goldens = hard_corner, hard_edge_and_back, hard_mu_two, hard_incompressible

from touchstone_test import (AUGMENTED, MULTIPLIERS, STEPS, below, check, checks, finish, folder, golden,
                             relative, run, same, tests)

for name in "hard_corner", "hard_edge_and_back", "hard_mu_two", "hard_incompressible":
    exact = golden(name)
    augmented = run(name, tests / f"{name}.prm", AUGMENTED)
    check(augmented.cuts() == 0, f"{name}: {augmented.cuts()} steps were cut")
    below(f"{name}, Newton iterations over those of elimination",
          augmented.iterations() / exact.iterations(), 1.5)
    same(exact, augmented, 1e-6)

# To half the height, by both. Steps that are cut are not the same: 1e-5 is their difference.
halved = checks / "rubber_half_height.prm"
exact = run("halved", halved)
augmented = run("halved_augmented", halved, AUGMENTED)
for k in range(3):
    below(f"half the height, force {k}",
          relative(augmented.force("high")[k], exact.force("high")[k]), 1e-4)

# A strip that is one element wide between two symmetry planes: they hold a component of all tied
# nodes, and the outer iteration has to close the others.
OUTER = {**AUGMENTED, "Contact/Augmentation": "outer"}
strip = tests / "rope.prm"
bent = {f"Body {half}/Boundary top/Traction z": "-1e-3 * t" for half in ("left half", "right half")}
exact, outer = run("strip", strip, {**bent, **MULTIPLIERS}), run("strip_outer", strip, {**bent, **OUTER})
below("strip, axial force", relative(outer.force("joint")[0], exact.force("joint")[0]), 1e-5)

# A bar that two planes press: F = E A d/L. However small the strain, the force is as exact: what an open gap leaves
# out is small beside the force, and not only beside the faces.
BAR = """
set Bodies        = bar
set Obstacles     = floor, press
set Contact pairs = below, above
subsection Body bar
  set Symmetry = left, front
  subsection Geometry
    set Upper corner = 1, 1, 2
    set Cells        = 3, 2, 4
    set Grading      = 1.5, 1, 2
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.4
  end
end
subsection Obstacle floor
  set Shape = plane
end
subsection Obstacle press
  set Shape     = plane
  set Point     = 0, 0, 2
  set Direction = 0, 0, -1
  set Motion z  = -2 * {strain} * t
end
subsection Contact pair below
  set Slave body       = bar
  set Slave boundaries = bottom
  set Obstacle         = floor
end
subsection Contact pair above
  set Slave body       = bar
  set Slave boundaries = top
  set Obstacle         = press
  set Pairing          = pointwise
end
"""
for strain in 5e-3, 1e-3, 1e-4:
    scene = folder / f"bar_{strain}.prm"
    scene.write_text(BAR.format(strain=strain), encoding="utf-8")
    bar = run(f"bar_{strain}", scene, AUGMENTED)
    below(f"bar, strain {strain}: force", abs(bar.force("above")[2] / (1000 * strain) + 1), 3e-7)

# Tied nodes that other pairs hold, too: what a refused condition would give is no force.
run("bolt_outer", tests / "pretension_with_friction.prm", {**OUTER, STEPS: 3})
finish()
