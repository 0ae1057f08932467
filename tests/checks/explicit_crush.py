# SPDX-License-Identifier: LGPL-2.1-or-later
"""A ring of metal that two planes crush sideways, against the rigid-plastic force of four hinges (DeRuntz
and Hodge 1963, J. Appl. Mech. 30, 381-390). Half a minute of processor time."""
# ctest: label = nightly

from math import sqrt

from touchstone_test import below, finish, folder, run

RADIUS, THICKNESS, YIELD, TRAVEL, STEPS = 20, 2, 200, 15, 60
SCENE = f"""set Bodies        = ring
set Obstacles     = top
set Contact pairs = top
subsection Body ring
  # One-point cells would have a fifth of the work in their hourglass modes.
  set Element  = F-bar
  set Symmetry = first cut, second cut, start, end
  subsection Geometry
    set Type         = tube
    set Axis         = y
    set Inner radius = {RADIUS - THICKNESS / 2}
    set Outer radius = {RADIUS + THICKNESS / 2}
    set Angle        = 90
    set Cells        = 4, 80, 1
  end
  subsection Material
    set Law           = finite-strain von Mises
    set Young modulus = 200e3
    set Poisson ratio = 0.3
    set Density       = 7.85e-9
    subsection Plasticity
      set Yield stress = {YIELD}
    end
  end
end
subsection Obstacle top
  set Shape     = plane
  set Point     = 0, 0, {RADIUS + THICKNESS / 2}
  set Direction = 0, 0, -1
  set Motion z  = -{TRAVEL} * min(1, t/4e-3)^2 * (3 - 2*min(1, t/4e-3))
end
subsection Contact pair top
  set Slave body       = ring
  set Slave boundaries = outer
  set Obstacle         = top
end
subsection Time integration
  set Scheme = central_differences
end
subsection Load stepping
  set End time = 4e-3
  set Steps    = {STEPS}
end
"""
(folder / "ring.prm").write_text(SCENE, encoding="utf-8")
ring = run("ring", folder / "ring.prm")
DIAMETER, MOMENT = 2 * RADIUS, 2 / sqrt(3) * YIELD * THICKNESS**2 / 4  # of plane strain, per length
# A quarter is computed: half of the force, half of the approach.
forces = [2 * abs(force) for force in ring.column("top: force z")]
times = [(i + 0.5) / STEPS for i in range(STEPS)]
approach = [2 * TRAVEL * t * t * (3 - 2 * t) / DIAMETER for t in times]
for wanted in 0.3, 0.5, 0.7:
    near = [i for i, part in enumerate(approach) if abs(part - wanted) < 0.03][:len(forces)]
    force = sum(forces[i] for i in near) / max(1, len(near))
    exact = sum(8 * MOMENT / DIAMETER / sqrt(1 - approach[i]**2) for i in near) / max(1, len(near))
    below(f"force at {wanted} of the diameter: {force:.2f} and {exact:.2f}", abs(force / exact - 1), 0.1)
below("balance error", abs(ring.value("motion", "energies", "balance_error")) /
      ring.value("motion", "energies", "external"), 1e-2)
finish()
