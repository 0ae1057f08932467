# SPDX-License-Identifier: LGPL-2.1-or-later
"""A block that two jaws press, load and lift moves with them, whatever its weight, law, solver and steps; and a ball
between plates rolls with them."""
# ctest: label = quick


from touchstone_test import below, check, finish, folder, relative, run

def block(names, force):
    """A block that no support holds, and the point in its middle."""
    return f"""
set Bodies = block
{names}
set Probes = middle
subsection Body block
  set Body force z = {force}
  subsection Geometry
    set Type         = box
    set Lower corner = 0, 0, 0
    set Upper corner = 1, 1, 1
    set Cells        = 3, 3, 3
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.3
    set Law           = neo-Hookean
  end
end
subsection Probe middle
  set Body  = block
  set Point = 0.5, 0.5, 0.5
end
"""


def displacements(result, component):
    """Displacement of the middle by time."""
    return {row["time"]: row[f"displacement_{component}"] for row in result.probe("middle")}


JAWS = block("set Obstacles = left, right\nset Contact pairs = at left, at right", "-20 * min(max(t - 1, 0), 1)") + "".join(f"""subsection Obstacle {side}
  set Shape     = plane
  set Point     = {point}, 0, 0
  set Direction = {sign}1, 0, 0
  set Motion x  = {sign}0.02 * min(t, 1)
  set Motion z  = 0.5 * max(t - 2, 0)
end
subsection Contact pair at {side}
  set Slave body       = block
  set Slave boundaries = {side}
  set Obstacle         = {side}
  set Behaviour        = coulomb
  subsection Friction
    set Coefficient = 0.3
  end
end
""" for side, point, sign in (("left", 0, ""), ("right", 1, "-"))) + """subsection Load stepping
  set End time = 3
  set Steps    = 12
end
"""
(folder / "jaws.prm").write_text(JAWS, encoding="utf-8")
SOLVER, ENFORCEMENT = "Linear solver/Type", "Contact/Enforcement"
for name, settings, ranks in (
        ("default", {}, 1), ("ranks", {}, 2), ("gmres", {SOLVER: "Belos GMRES"}, 1),
        ("multipliers", {ENFORCEMENT: "lagrange multipliers"}, 1), ("augmented", {ENFORCEMENT: "augmented lagrange"}, 1),
        ("linear", {"Body block/Material/Law": "linear elastic"}, 1),
        ("half", {"Body block/Symmetry": "front", "Body block/Geometry/Cells": "3, 2, 3"}, 1),
        ("light", {"Body block/Body force z": "-min(max(t - 1, 0), 1)"}, 1), ("steps", {"Load stepping/Steps": 24}, 1)):
    lifted = run(name, "jaws.prm", settings, ranks=ranks)
    height = displacements(lifted, "z")
    below(f"{lifted}: lifted by 0.5", relative(height[3.] - height[2.], 0.5), 1e-6)
    check("trying again" not in lifted.log, f"{lifted}: a step was made again")

# A punch that pushes a block over a floor without friction, and goes back: the block stays where it is.
PUNCH = block("set Obstacles = floor, punch\nset Contact pairs = on floor, at punch", -1) + """subsection Obstacle floor
  set Shape = plane
end
subsection Contact pair on floor
  set Slave body       = block
  set Slave boundaries = bottom
  set Obstacle         = floor
end
subsection Obstacle punch
  set Shape     = plane
  set Direction = 1, 0, 0
  set Motion x  = 0.2 * (min(t, 1) - max(t - 1, 0))
end
subsection Contact pair at punch
  set Slave body       = block
  set Slave boundaries = left
  set Obstacle         = punch
end
subsection Load stepping
  set End time = 2
  set Steps    = 4
end
"""
(folder / "punch.prm").write_text(PUNCH, encoding="utf-8")
pushed = run("pushed", "punch.prm")
at = displacements(pushed, "x")
below("the block is pushed", relative(at[1.], 0.2), 1e-3)
below("the block stays", relative(at[2.], at[1.]), 1e-3)

# A ball between two plates, of which the upper one moves by 1.5: it rolls by 43 degrees, and its centre moves by half as
# much, as it is symmetric about it. In 16 steps it took up to 49 iterations in one, and one run of several lost all contact
# (exit code 0 with a warning): round-off decided.
BALL = """
set Bodies        = ball
set Obstacles     = low, high
set Contact pairs = on low, at high
set Probes        = middle
subsection Body ball
  subsection Geometry
    set Type   = ball
    set Centre = 0, 0, 1
    set Radius = 1
    set Cells  = 3, 4
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.3
    set Law           = neo-Hookean
  end
end
subsection Probe middle
  set Body  = ball
  set Point = 0, 0, 1
end
""" + "".join(f"""subsection Obstacle {name}
  set Shape     = plane
  set Point     = 0, 0, {height}
  set Direction = 0, 0, {sign}1
{motion}
end
subsection Contact pair {pair}
  set Slave body       = ball
  set Slave boundaries = surface
  set Obstacle         = {name}
  set Behaviour        = coulomb
  subsection Friction
    set Coefficient = 0.3
  end
end
""" for name, pair, height, sign, motion in (
    ("low", "on low", 0, "", ""),
    ("high", "at high", 2, "-", "  set Motion z = -0.1 * min(t, 1)\n  set Motion x = 1.5 * max(t - 1, 0)"))) + """
subsection Load stepping
  set End time = 2
end
"""
(folder / "ball.prm").write_text(BALL, encoding="utf-8")
STEPS = "Load stepping/Steps"
for name, settings, ranks in (
        ("rolled", {STEPS: 4}, 1), ("rolled_16", {STEPS: 16}, 1), ("rolled_2_ranks", {STEPS: 16}, 2),
        ("rolled_multipliers", {STEPS: 16, ENFORCEMENT: "lagrange multipliers"}, 1),
        ("rolled_half", {STEPS: 16, "Body ball/Symmetry": "y cut", "Body ball/Geometry/Keep": "both, +, both"}, 1)):
    rolled = run(name, "ball.prm", settings, ranks=ranks)
    below(f"{rolled}: centre", relative(displacements(rolled, "x")[2.], 0.75), 1e-8)
    below(f"{rolled}: iterations of a step", max(rolled.column("Newton iterations")), 9)
finish()
