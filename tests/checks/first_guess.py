# SPDX-License-Identifier: LGPL-2.1-or-later
"""Driven bodies begin a static step where their supports move them (doc/theory.md 5): contact has the
right active set at once where they slide, and what such a guess cannot be made for has the same result
in one step and in many; bodies that are driven against obstacles."""

from touchstone_test import CG, STEPS, below, check, finish, folder, prm, relative, run

tubes = run("tubes", prm / "two_tubes.prm", {**CG, STEPS: 1})
setups = tubes.summary["counts"]["preconditioner_setups"]
check(setups == 1, f"tubes that slide by two slave faces: {setups} preconditioners, so the active set has changed")
check(tubes.iterations() <= 5, f"tubes: {tubes.iterations()} iterations")

# A punch bends a thin plate: moved as a whole it would be behind the plate.
PLATE = """
set Bodies        = plate, punch
set Contact pairs = c
subsection Body plate
  set Fixed = left, right
  subsection Geometry
    set Lower corner = -5, 0, 0
    set Upper corner = 5, 1, 0.1
    set Cells        = 40, 4, 1
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.3
  end
end
subsection Body punch
  set Boundary conditions = top
  subsection Geometry
    set Lower corner = -0.5, 0, 0.1
    set Upper corner = 0.5, 1, 1.1
    set Cells        = 3, 3, 3
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.3
  end
  subsection Boundary top
    set Displacement x = 0
    set Displacement y = 0
    set Displacement z = -{depth} * t
  end
end
subsection Contact pair c
  set Slave body        = punch
  set Slave boundaries  = bottom
  set Master body       = plate
  set Master boundaries = top
end
"""
for depth in 0.05, 0.3, 0.6:
    scene = folder / f"plate_{depth}.prm"
    scene.write_text(PLATE.format(depth=depth), encoding="utf-8")
    once, often = (run(f"plate_{depth}_{steps}", scene, {STEPS: steps}).force("c")[2] for steps in (1, 8))
    check(once > 0, f"plate: force {once} at {depth}")
    below(f"plate bent by {depth}: one step and eight", relative(once, often), 1e-6)
# A slave body that is driven against a ball at rest, which a point between its nodes meets: its row has slave nodes
# in its stencil and no master. Driven against the body, the ball presses alike.
BALL = """
set Bodies = low
set Contact pairs = c
set Obstacles = ball
subsection Body low
  set Boundary conditions = bottom
  subsection Boundary bottom
    set Displacement x = 0
    set Displacement y = 0
    set Displacement z = {low} * t
  end
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
subsection Obstacle ball
  set Shape = sphere
  set Point = 0.05, 0.03, 3
  set Radius = 3
  set Motion z = -{ball} * t
end
subsection Contact pair c
  set Slave body = low
  set Slave boundaries = top
  set Obstacle = ball
end
subsection Load stepping
  set End time = 1
  set Steps = 2
end
"""
forces = []
for low, ball in ((0.008, 0), (0, 0.008)):
    scene = folder / f"ball_{low}.prm"
    scene.write_text(BALL.format(low=low, ball=ball), encoding="utf-8")
    forces.append(run(f"ball_{low}", scene).force("c")[2])
below("body against ball and ball against body", relative(*forces), 1e-9)
finish()
