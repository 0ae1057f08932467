# SPDX-License-Identifier: LGPL-2.1-or-later
"""Obstacles and reference points that a formula turns by any angle in one step of the input: the answer of small
steps."""
# ctest: label = quick

from touchstone_test import below, check, finish, folder, relative, run, tests

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

# It takes no cuts: these are for steps that do not converge.
uncut = run("uncut", "rod.prm", {"Load stepping/Maximum cuts": 0})
below("moment without cuts", relative(uncut.column("joint: moment z")[-1], moments[0]), 1e-8)
# What nothing touches may turn by any angle, and jump.
apart = run("apart", tests / "turning_roller.prm", {"Obstacle roller/Motion z": "1", STEPS: 2,
                                                   "Obstacle roller/Rotate angle": "if(t < 1.5, 0, 170)"})
check(len(apart.column("time")) <= 3, f"{apart}: steps that nothing needs")
finish()
