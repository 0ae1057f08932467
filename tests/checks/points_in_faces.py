# SPDX-License-Identifier: LGPL-2.1-or-later
"""Slave faces that an obstacle or a master enters between their nodes: one answer of enforcements,
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
TUBE = LOW.format(more=", tube") + """
subsection Body tube
  set Boundary conditions = first cut, second cut
  subsection Boundary first cut
    set Displacement x = 0
    set Displacement y = 0
    set Displacement z = -0.005 * t
  end
  subsection Boundary second cut
    set Displacement x = 0
    set Displacement y = 0
    set Displacement z = -0.005 * t
  end
  subsection Geometry
    set Type = tube
    set Axis = x
    set Origin = 0, 0.02, 2
    set Start = -0.15
    set End = 0.15
    set Inner radius = 1.6
    set Outer radius = 2
    set First angle = 255
    set Angle = 30
    set Cells = 2, 24, 2
  end
  subsection Material
    set Young modulus = 1000
  end
end
subsection Contact pair c
  set Slave body = low
  set Slave boundaries = top
  set Master body = tube
  set Master boundaries = outer
  set Pairing = pointwise
end
subsection Load stepping
  set End time = 1
  set Steps = 1
end
"""
# Deepest in all faces of a row, each of which shares nodes with the next.
ROW = BALL.replace("Shape = sphere", "Shape = cylinder\n  set Direction = 0, 1, 0").replace(
    "Point = 0.05, 0.03, 3", "Point = 0, 0, 3").replace("-0.008", "-0.004")
# Narrower than the distance of the places where it is searched for.
NARROW = ROW.replace("Point = 0, 0, 3", "Point = 0.05, 0, 1").replace("Radius = 3", "Radius = 1").replace(
    "-0.004", "-0.001")


def difference(a, b):
    """Of the forces of two runs, relative to the first."""
    size = max(map(abs, a.force("c")))
    return max(abs(x - y) for x, y in zip(a.force("c"), b.force("c"))) / size


for name, text, points in (("ball", BALL, 1), ("tube", TUBE, 1), ("row", ROW, 5),
                           ("narrow", NARROW, 5)):
    (folder / f"{name}.prm").write_text(text, encoding="utf-8")
    scene = f"{name}.prm"
    one = run(name, scene, vtu=None)
    # Points have no area: no row of a node carries anything.
    check(one.contact("c", "area") == 0 and one.contact("c", "active") == points,
          f"{name}: not {points} points")
    size = max(map(abs, one.force("c")))
    below(f"{name}: force across", abs(one.force("c")[1]) / size if points == 5 else 0., 1e-9)
    # Refined by eight, the ball has a force of 2.1 instead of 7.1: the run must say so, once.
    words = one.summary["warnings"]
    check(len(words) == 1 and "narrower than the slave faces" in words[0], f"{name}: {words}")
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
# Nodes on one side of the ridge touch, and it lies in the faces beside them nine times as deep: a force of 1.35, where a
# mesh that is four times finer has 12.9.
(folder / "beside.prm").write_text(NARROW.replace("-0.001", "-0.0125"), encoding="utf-8")
beside = run("beside", "beside.prm")
words = beside.summary["warnings"]
check(len(words) == 1 and "narrower than the slave faces. Between slave nodes" in words[0], f"beside: {words}")
fine = run("beside_fine", "beside.prm", {"Discretisation/Refinement factor": 4})
check(not fine.summary["warnings"], f"beside_fine: {fine.summary['warnings']}")
finish()
