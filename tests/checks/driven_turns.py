# SPDX-License-Identifier: LGPL-2.1-or-later
"""Obstacles, reference points and bodies that formulas turn by any angle in one step of the input: the answer of
small steps."""
# ctest: label = quick

from touchstone_test import below, check, finish, folder, relative, run, same, tests

STEPS = "Load stepping/Steps"
ROD = """
set Bodies        = rod
set Obstacles     = end
set Contact pairs = joint
subsection Body rod
  set Fixed = bottom
  subsection Geometry
    set Type         = box
    set Lower corner = -0.5, -0.5, 0
    set Upper corner = 0.5, 0.5, 6
    set Cells        = 2, 2, 12
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.3
    set Law           = neo-Hookean
  end
end
subsection Obstacle end
  set Shape        = reference point
  set Rotate axis  = 0, 0, 1
  set Rotate angle = 360*t
end
subsection Contact pair joint
  set Slave body       = rod
  set Slave boundaries = top
  set Obstacle         = end
  set Behaviour        = tied
end
subsection Load stepping
  set Steps = 1
end
"""
# A block that is pressed onto a plane, and then turned on the spot by the displacement of its top.
BLOCK = """
set Bodies        = block
set Obstacles     = plane
set Contact pairs = contact
subsection Body block
  set Boundary conditions = top
  subsection Geometry
    set Type         = box
    set Lower corner = 4.5, -0.5, 0
    set Upper corner = 5.5, 0.5, 0.5
    set Cells        = 4, 4, 2
  end
  subsection Material
    set Law           = neo-Hookean
    set Young modulus = 1000
    set Poisson ratio = 0.3
  end
  subsection Boundary top
    set Displacement x = (x - 5) * (cos(ANGLE) - 1) - y * sin(ANGLE)
    set Displacement y = (x - 5) * sin(ANGLE) + y * (cos(ANGLE) - 1)
    set Displacement z = -0.005 * min(t, 1)
  end
end
subsection Obstacle plane
  set Shape     = plane
  set Direction = 0, 0, 1
  set Point     = 0, 0, 0
end
subsection Contact pair contact
  set Slave body       = block
  set Slave boundaries = bottom
  set Obstacle         = plane
  set Behaviour        = coulomb
  subsection Friction
    set Coefficient = 0.2
  end
end
subsection Load stepping
  set End time = 2
  set Steps    = 2
end
"""

# Twisted by a whole turn: in one step nothing was seen of it, a moment of 0 (exit code 0).
(folder / "rod.prm").write_text(ROD, encoding="utf-8")
moments = [run(f"rod_{steps}", "rod.prm", {STEPS: steps}).column("joint: moment z")[-1] for steps in (16, 1)]
below(f"moments of the rod {moments}", relative(moments[1], moments[0]), 1e-8)
check(abs(moments[0]) > 60, f"the rod is not twisted: {moments}")

# A roller under which the slab stays: mu N against the way that it turns, whatever the angle of a step. A third of a
# turn and less had 0.5 to 0.97 of it, more had the wrong sign, and whole turns had none (exit code 0).
fine = None
for angle, steps in (9, 9), (360, 6), (-360, 4), (1080, 3):
    result = run(f"roller_{angle}", tests / "turning_roller.prm",
                 {"Obstacle roller/Rotate angle": f"{angle} * max(t - 1, 0)", STEPS: steps})
    pull, press = result.column("contact: force x")[-1], result.column("contact: force z")[-1]
    fine = fine or abs(pull / press)
    below(f"{result}: pull over pressure", relative(abs(pull / press), fine), 1e-2)
    check((pull < 0) == (angle > 0), f"{result}: pulls the other way")

# The same of a body: in one step of 90 degrees it had 0.94 of the moment, in one of 360 none (exit code 0).
fine = None
for degrees, steps in (12, 4), (90, 2), (-360, 2):
    name = f"block_{degrees}.prm"
    (folder / name).write_text(BLOCK.replace("ANGLE", f"{degrees}*pi/180*max(t - 1, 0)"), encoding="utf-8")
    result = run(name[:-4], name, {STEPS: steps})
    lever = ((result.column("contact: moment z")[-1] - 5 * result.column("contact: force y")[-1])
             / result.column("contact: force z")[-1])
    fine = fine or abs(lever)
    below(f"{result}: moment over pressure", relative(abs(lever), fine), 2e-2)
    check((lever < 0) == (degrees > 0), f"{result}: the moment has the sign of the turn")
same(result, run("block_2_ranks", name, {STEPS: 2}, 2), 1e-8)

# It takes no cuts: these are for steps that do not converge.
uncut = run("uncut", "rod.prm", {"Load stepping/Maximum cuts": 0})
below("moment without cuts", relative(uncut.column("joint: moment z")[-1], moments[0]), 1e-8)
# What nothing touches may turn by any angle, and jump.
apart = run("apart", tests / "turning_roller.prm", {"Obstacle roller/Motion z": "1", STEPS: 2,
                                                   "Obstacle roller/Rotate angle": "if(t < 1.5, 0, 170)"})
check(len(apart.column("time")) <= 3, f"{apart}: steps that nothing needs")
finish()
