# SPDX-License-Identifier: LGPL-2.1-or-later
"""How implicit dynamics starts: from a load that acts at once, on a mesh with hanging nodes, a free block has the momentum
of the load; supports that accelerate from rest carry the mass times their acceleration."""
# ctest: label = quick

from touchstone_test import below, finish, folder, run

BLOCK = """
set Bodies        = block
set Obstacles     = plane
set Contact pairs = contact
subsection Body block
  set Body force x       = 5
  set Body force z       = -8
  set Initial velocity x = 8
  subsection Geometry
    set Type         = box
    set Lower corner = 0, 0, 0
    set Upper corner = 1, 1, 0.5
    set Cells        = 3, 3, 2
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.3
    set Density       = 1
  end
end
subsection Obstacle plane
  set Shape = plane
  set Point = 0, 0, -50
end
subsection Contact pair contact
  set Slave body       = block
  set Slave boundaries = bottom
  set Obstacle         = plane
end
subsection Load stepping
  set End time = 0.5
  set Steps    = 10
end
subsection Refinement
  set Estimator       = region
  set Region          = if(x < 0.4 && z < 0.3, 1, -1)
  set Cycles          = 1
  set Cycles per step = 0
  set Maximum level   = 1
end
"""

# Nodes that hanging nodes follow had their forces and not their mass: momenta 1e-3 and 4e-3 off (exit code 0).
(folder / "block.prm").write_text(BLOCK, encoding="utf-8")
SCHEME, DEGREE = "Time integration/Scheme", "Discretisation/Degree"
for name, settings, ranks in (("newmark", {SCHEME: "newmark"}, 1), ("ranks", {SCHEME: "newmark"}, 2),
                              ("hht", {SCHEME: "hht"}, 1), ("alpha", {SCHEME: "generalized_alpha"}, 1),
                              ("degree_2", {SCHEME: "newmark", DEGREE: 2}, 1)):
    result = run(name, "block.prm", settings, ranks=ranks)
    for axis, before, force in ("x", 4., 2.5), ("z", 0., -4.):
        worst = max(abs(p - before - force * t) for p, t in zip(result.column(f"momentum {axis}"), result.column("time")))
        below(f"{result}: momentum {axis}", worst / 4., 1e-9)

# A driven cube: its supports had 2, 0, 2, 0 ... of this force (newmark, exit code 0), as nodes began without acceleration.
CUBE = """
set Bodies = cube
subsection Body cube
  set Symmetry            = left, front
  set Boundary conditions = bottom, top
  subsection Boundary bottom
    set Displacement z = 0.5 * t^2
  end
  subsection Boundary top
    set Displacement z = 0.5 * t^2
  end
  subsection Geometry
    set Type         = box
    set Upper corner = 1, 1, 1
    set Cells        = 1, 1, 1
  end
  subsection Material
    set Young modulus = 1000
    set Density       = 1
  end
end
subsection Load stepping
  set Steps = 10
end
"""
(folder / "cube.prm").write_text(CUBE, encoding="utf-8")
for scheme in "newmark", "hht", "generalized_alpha":
    driven = run(f"driven_{scheme}", "cube.prm", {SCHEME: scheme})
    supports = [a + b for a, b in zip(driven.column("cube/bottom: reaction z"), driven.column("cube/top: reaction z"))]
    below(f"{driven}: force of the supports", max(abs(force - 1) for force in supports[1:]), 1e-4)
finish()
