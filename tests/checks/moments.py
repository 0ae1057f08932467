# SPDX-License-Identifier: LGPL-2.1-or-later
"""Moments on boundaries of bodies at finite strain, which turn: the angular momentum of a free block
is the impulse of the moment, in implicit and explicit dynamics; a force at a point on an arm keeps
its moment; a cantilever is rolled up to the circle of the exact solution."""

import math

from touchstone_test import (STEPS, below, check, checks, finish, folder, relative, run)

block, beam = checks / "free_block.prm", checks / "rolled_beam.prm"
IN_CYCLES = {"Time integration/Scheme": "central_differences", STEPS: 10}


def impulse(name, settings, ranks=1):
    """Times and angular momenta."""
    result = run(name, block, settings, ranks)
    return result, list(zip(result.column("time"), result.column("angular momentum z")))


_, momenta = impulse("implicit", {STEPS: 400})
for time, momentum in momenta[40::40] + momenta[-1:]:
    below(f"angular momentum at {time:g}", relative(momentum, 8 * time), 1e-3)
below("two ranks", relative(impulse("implicit-2", {STEPS: 400}, 2)[1][-1][1], momenta[-1][1]), 1e-9)
# Velocities of the scheme lag by half a cycle; their change is exact.
explicit, momenta = impulse("explicit", IN_CYCLES)
for time, momentum in momenta[1:]:
    below(f"explicit: angular momentum at {time:g}",
          relative(momentum - momenta[0][1], 8 * (time - momenta[0][0])), 1e-9)
below("explicit: all of it", relative(momenta[-1][1], 8), 2e-3)
check((explicit.folder / "statistics").read_text(encoding="utf-8") ==
      (impulse("explicit-2", IN_CYCLES, 2)[0].folder / "statistics").read_text(encoding="utf-8"),
      "explicit: two ranks differ")


def bent(moment, length=10., modulus=1200.):
    """Stretch and curvature of a beam of height 1 with E11 = (f^2 - 1)/2, f = stretch - curvature z
    and no lateral strain, without a force: its end, and the place of the end."""
    points = [(-0.5 * math.sqrt(3 / 7 + 2 / 7 * math.sqrt(6 / 5)), 18 - math.sqrt(30)),
              (-0.5 * math.sqrt(3 / 7 - 2 / 7 * math.sqrt(6 / 5)), 18 + math.sqrt(30))]
    points = [(sign * z, weight / 72) for z, weight in points for sign in (1, -1)]
    stretch, curvature = 1., 12 * moment / modulus
    for _ in range(30):
        # f (f^2 - 1)/2 and its derivative
        values = [(z, w, f * (f * f - 1) / 2, (3 * f * f - 1) / 2) for z, w in points
                  for f in (stretch - curvature * z,)]
        force = sum(w * p for z, w, p, _ in values)
        missing = sum(-w * z * p for z, w, p, _ in values) - moment / modulus
        a, b, c = (sum(w * z**k * d for z, w, _, d in values) for k in range(3))
        # (force, missing) by (stretch, curvature): ((a, -b), (-b, c))
        determinant = a * c - b * b
        stretch -= (c * force + b * missing) / determinant
        curvature -= (b * force + a * missing) / determinant
    angle = curvature * length
    return stretch / curvature * math.sin(angle), stretch / curvature * (1 - math.cos(angle))


def tip(result):
    """Where the end of the beam is."""
    row = result.probe("tip")[-1]
    return 10 + row["displacement_x"], row["displacement_z"]


def apart(first, second):
    """Distance of two places, relative to the beam."""
    return math.dist(first, second) / 10


rolled = run("rolled", beam)
below("end of the rolled beam", apart(tip(rolled), bent(5 * math.pi)), 5e-3)
below("iterations", max(rolled.column("Newton iterations")), 12)
below("two ranks", apart(tip(rolled), tip(run("rolled-2", beam, ranks=2))), 1e-8)
# The same by a reference point that is tied to the end.
tied = beam.read_text(encoding="utf-8").replace("set Boundary conditions = right", "")
at = tied.index("  subsection Boundary right")
tied = tied[:at] + tied[tied.index("  end\n", at) + 6:] + """
set Obstacles     = reference
set Contact pairs = tie
subsection Obstacle reference
  set Shape           = reference point
  set Reference point = 10, 0.5, 0
  set Free directions = x, y, z, about x, about y, about z
  set Moment y        = -5*pi*t
end
subsection Contact pair tie
  set Slave body       = beam
  set Slave boundaries = right
  set Obstacle         = reference
  set Behaviour        = tied
end
"""
(folder / "tied.prm").write_text(tied, encoding="utf-8")
below("against a reference point", apart(tip(rolled), tip(run("tied", folder / "tied.prm"))), 1e-3)
finish()
