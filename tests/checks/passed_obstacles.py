# SPDX-License-Identifier: LGPL-2.1-or-later
"""Obstacles that a slave surface goes through within one step: the step is cut until they carry, or the run
ends with the reason; never exit code 0 with what is left behind them."""
# ctest: label = quick

from touchstone_test import below, check, finish, folder, run, tests

BLOCK = """
set Bodies        = block
set Obstacles     = tool
set Contact pairs = sole
subsection Body block
{holds}
  subsection Geometry
    set Type         = box
    set Lower corner = {lower}
    set Upper corner = {upper}
    set Cells        = {cells}
  end
  subsection Material
    set Law           = neo-Hookean
    set Poisson ratio = 0.3
    set Young modulus = 100
  end
end
subsection Obstacle tool
{tool}
end
subsection Contact pair sole
  set Slave body       = block
  set Slave boundaries = bottom
  set Obstacle         = tool
end
subsection Load stepping
  set Steps = 1
end
"""
STEPS = "Load stepping/Steps"
HELD = "  set Fixed = top"
WHOLE = {"lower": "-1, -1, 0", "upper": "1, 1, 1", "cells": "4, 4, 2"}
THROUGH = "has passed through the obstacle 'tool' within one step"


def write(name, **parts):
    (folder / f"{name}.prm").write_text(BLOCK.format(**parts), encoding="utf-8")
    return f"{name}.prm"


def stl_box(name, low, high):
    """A closed surface of twelve triangles, normals outwards."""
    corners = [[(low, high)[i >> d & 1][d] for d in range(3)] for i in range(8)]
    sides = (0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)
    lines = ["solid box"]
    for a, b, c, d in sides:
        for triangle in ((a, b, c), (a, c, d)):
            lines += ["facet normal 0 0 0", "outer loop"]
            lines += [f"vertex {' '.join(map(str, corners[i]))}" for i in triangle]
            lines += ["endloop", "endfacet"]
    (folder / name).write_text("\n".join(lines + ["endsolid box"]), encoding="utf-8")


# A block that is loaded on to a ring, which is thin. In one step it went through, and hung on two of its nodes with
# the right force and twenty times the pressure (exit code 0).
ring = write("ring", lower="0, 0, 0", upper="1.5, 1.5, 1", cells="6, 6, 4", holds="""  set Symmetry = left, front
  set Boundary conditions = top
  subsection Boundary top
    set Pressure = 4 * t
  end""", tool="""  set Shape       = torus
  set Centre      = 0, 0, -0.25
  set Direction   = 0, 0, 1
  set Radius      = 1
  set Tube radius = 0.25""")
fine = run("ring_4", ring, {STEPS: 4})
for ranks in 1, 2:
    once = run(f"ring_1_{ranks}", ring, ranks=ranks)
    once.says(THROUGH)
    for name in "force z", "max pressure":
        ends = [one.column(f"sole: {name}")[-1] for one in (fine, once)]
        below(f"{once}, {name}: {ends}", abs(ends[1] / ends[0] - 1), 1e-8)

# Springs let the block in at both ends of the step.
SPRINGS = {"Contact/Enforcement": "penalty"}
ends = [run(f"ring_penalty_{steps}", ring, {**SPRINGS, STEPS: steps}).column("sole: max pressure")[-1] for steps in (4, 1)]
below(f"ring, penalty, max pressure: {ends}", abs(ends[1] / ends[0] - 1), 1e-8)

# A sheet that is driven into the block, by its thickness in a step, or five times that: no force, exit code 0.
stl_box("sheet.stl", (-2, -2, -0.04), (2, 2, 0))
sheet = write("sheet", holds=HELD, **WHOLE, tool="  set Shape    = stl\n  set File     = sheet.stl\n"
              "  set Motion z = 0.2 * t - 0.001")
fine = run("sheet_40", sheet, {STEPS: 40})
for steps in 1, 5:
    cut = run(f"sheet_{steps}", sheet, {STEPS: steps})
    cut.says(THROUGH)
    ends = [one.column("sole: force z")[-1] for one in (fine, cut)]
    below(f"{cut}, force: {ends}", abs(ends[1] / ends[0] - 1), 1e-8)

# A ball smaller than a face that goes through it into the block, where no node can tell of it.
ball = write("ball", holds=HELD, **WHOLE, tool="  set Shape    = sphere\n  set Point    = 0.22, 0.26, -0.11\n"
             "  set Radius   = 0.1\n  set Motion z = 0.6 * t")
inside = run("ball", ball, fails=True)
inside.says(THROUGH)

# What turns in its place, by 40 degrees in each step, has gone through nothing, nor has what it is pressed on.
spinning = run("spinning", tests / "turning_roller.prm", {"Obstacle roller/Rotate angle": "120 * max(t - 1, 0)",
                                                          "Contact pair contact/Behaviour": "frictionless"})
check("trying again" not in spinning.log, f"{spinning}: a step was made again")
# Nor has what slides round a tool: a block is drawn over the edge of a box, which the straight way of its nodes cuts by
# as much as it slides.
stl_box("bench.stl", (-3, -3, -1), (0.4, 3, 0))
over = write("over", holds="  set Boundary conditions = top\n  subsection Boundary top\n    set Displacement x = 0.5 * t\n"
             "    set Displacement y = 0\n    set Displacement z = -0.05\n  end", **WHOLE,
             tool="  set Shape = stl\n  set File  = bench.stl\n  set Rotate axis  = 0, 1, 0\n  set Rotate angle = 1e-9 * t")
drawn = run("drawn", over)
check(THROUGH not in drawn.log, f"{drawn}: taken for a passage")
finish()
