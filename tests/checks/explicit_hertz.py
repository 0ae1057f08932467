# SPDX-License-Identifier: LGPL-2.1-or-later
"""Impact of aluminium balls (R = 8 mm) on graded meshes: Hertz's approach, time of contact and force,
on a rigid plane at 5 m/s and of two that close at 5 m/s (doc/explicit.md, section 9.7). Half a
minute, three quarters of one and two and a half minutes of processor time."""
# ctest: label = nightly

import math

from touchstone_test import STEPS, below, contact_gives, finish, folder, relative, run
from graded_ball import GradedBall  # of contrib/, which touchstone_test finds

MATERIAL = """
  subsection Material
    set Young modulus = 70e3
    set Poisson ratio = 0.33
    set Density       = 2.7e-9
  end
"""
END = """
subsection Time integration
  set Scheme                   = central_differences
  set Linear bulk viscosity    = 0
  set Quadratic bulk viscosity = 0
end
subsection Load stepping
  set End time = 40e-6
  set Steps    = 200
end
subsection Output
  set VTU interval = 0
end
"""


def ball(name, velocity, centre):
    """The section of a ball with its mesh file."""
    return f"""
subsection Body {name}
  set Element            = one point
  set Symmetry           = x cut, y cut
  set Initial velocity z = {velocity}
  subsection Geometry
    set Type           = file
    set File           = {name}.msh
    set Exact surfaces = surface: sphere point 0 0 {centre} radius 8 outside
  end
{MATERIAL}end
"""


def judge(result, speed, exact, allowed):
    """Approach of the centres, time of contact and force against Hertz's. The approach is the way of the
    mean velocity, from the touch to the largest force, of one ball."""
    rows = result.rows()
    step, mass = rows[0]["time"], 2.7e-9 * 4 / 3 * math.pi * 512 / 4
    forces = [4 * abs(row["impact: force z"]) for row in rows]
    velocity = result.value("motion", "velocities", "upper", 2)
    # Of the meshed ball, by its velocity and momentum after the impact: less than that of the ball.
    moved = approach = 0
    momentum = [0.0, *(sum(forces[:n + 1]) * step / 4 for n in range(len(forces)))]
    for p, q in zip(momentum, momentum[1:]):
        moved += step * (speed - 0.5 * (p + q) / (momentum[-1] / (velocity + speed)))
        approach = max(approach, moved)
    below(f"{result}, mass", abs(momentum[-1] / (velocity + speed) / mass - 1), 0.01)
    contact = step * sum(force > 1e-4 * exact[2] for force in forces)
    print(f"{result}: {result.value('cells'):g} cells, {result.value('cycles'):g} cycles, "
          f"{result.value('seconds', 'cpu'):.0f} s")
    for name, value, of_hertz, bound in zip(("approach", "time of contact", "force"),
                                            (approach, contact, max(forces)), exact, allowed):
        print(f"{result}: {name} {value:.5g}, after Hertz {of_hertz:.5g}")
        below(f"{result}, {name}", relative(value, of_hertz), bound)
    below(f"{result}, rebound", abs(velocity / speed - 1), 0.01)
    contact_gives(result, 1e-6)


PLANE = """
subsection Obstacle ground
  set Shape     = plane
  set Point     = 0, 0, 0
  set Direction = 0, 0, 1
end
subsection Contact pair impact
  set Slave body       = upper
  set Slave boundaries = surface
  set Obstacle         = ground
end
"""
PAIR = """
subsection Contact pair impact
  set Slave body        = upper
  set Slave boundaries  = surface
  set Master body       = lower
  set Master boundaries = surface
end
"""
GradedBall(8, 0.08, 16, 16, 14).write(folder / "upper.msh", (0, 0, 8))
GradedBall(8, 0.09, 15, 14, 13).write(folder / "lower.msh", (0, 0, -8), -1)
(folder / "plane.prm").write_text(
    "set Bodies = upper\nset Obstacles = ground\nset Contact pairs = impact\n" +
    ball("upper", -5000, 8) + PLANE + END, encoding="utf-8")
(folder / "two.prm").write_text(
    "set Bodies = upper, lower\nset Contact pairs = impact\n" +
    ball("upper", -2500, 8) + ball("lower", 2500, -8) + PAIR + END, encoding="utf-8")

# A ball is stiffer than the half space of Hertz's theory, by a part that is proportional to a/R: its
# force is 3.7 % larger at 5 m/s whatever the mesh, and 2.2 % at 1 m/s (doc/explicit.md, section 9.7).
judge(run("plane", folder / "plane.prm"), 5000, (0.051804, 30.495e-6, 3493), (0.04, 0.03, 0.04))
judge(run("slow", folder / "plane.prm", {"Body upper/Initial velocity z": -1000,
                                         "Load stepping/End time": 56e-6, STEPS: 140}),
      1000, (0.014295, 42.074e-6, 506.34), (0.025, 0.02, 0.025))
judge(run("two", folder / "two.prm", {"Load stepping/End time": 44e-6}), 2500,
      (0.059508 / 2, 35.029e-6, 1520), (0.03, 0.03, 0.035))
finish()
