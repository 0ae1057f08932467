# SPDX-License-Identifier: LGPL-2.1-or-later
"""Slave faces that an obstacle enters between their nodes: one answer of enforcements,
solvers, ranks and numbers of steps, balance, forces of nodes in contact.vtu."""
# ctest: label = quick

from touchstone_test import (AUGMENTED, CG, MULTIPLIERS, STEPS, below, check, finish, folder,
                             run)

LOW = """
set Bodies = low{more}
set Contact pairs = c
subsection Body low
  set Fixed = bottom
  subsection Geometry
    set Type = box
    set Lower corner = -1, -1, -1
    set Upper corner = 1, 1, 0
    set Cells = 5, 5, 3
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.3
  end
end
"""
BALL = LOW.format(more="\nset Obstacles = ball") + """
subsection Obstacle ball
  set Shape = sphere
  set Point = 0.05, 0.03, 3
  set Radius = 3
  set Motion z = -0.008 * t
end
subsection Contact pair c
  set Slave body = low
  set Slave boundaries = top
  set Obstacle = ball
end
subsection Load stepping
  set End time = 1
  set Steps = 1
end
"""


def difference(a, b):
    """Of the forces of two runs, relative to the first."""
    size = max(map(abs, a.force("c")))
    return max(abs(x - y) for x, y in zip(a.force("c"), b.force("c"))) / size


name = "ball"
(folder / f"{name}.prm").write_text(BALL, encoding="utf-8")
scene = f"{name}.prm"
one = run(name, scene, vtu=None)
# Points have no area: no row of a node carries anything.
check(one.contact("c", "area") == 0 and one.contact("c", "active") == 1, f"{name}: no point")
check(not one.summary["warnings"], f"{name}: {one.summary['warnings']}")
reaction = one.reaction("low", "bottom")
below(f"{name}: balance", max(abs(f + r) for f, r in zip(one.force("c"), reaction)) /
      max(map(abs, reaction)), 1e-9)
found = [sum(node.force[d] for node in one.contact_nodes()) for d in range(3)]
below(f"{name}: forces of nodes and of the pair",
      max(abs(a - b) for a, b in zip(found, one.force("c"))) / max(map(abs, found)), 1e-6)
for other, settings, ranks, bound in (
        ("multipliers", MULTIPLIERS, 1, 1e-8), ("augmented", AUGMENTED, 1, 1e-7),
        ("cg", CG, 1, 1e-7), ("ranks", {}, 2, 1e-8), ("steps", {STEPS: 3}, 1, 1e-7),
        ("consistent", {"Contact/Linearisation": "consistent"}, 1, 1e-8)):
    result = run(f"{name}_{other}", scene, settings, ranks=ranks)
    below(f"{name}, {other}: force", difference(one, result), bound)
finish()
