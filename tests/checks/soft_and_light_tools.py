# SPDX-License-Identifier: LGPL-2.1-or-later
"""Obstacles that forces move, which seem to be free and are not: at the end of a slender beam, with a small load on a
face that others push, and where the forces in balance vanish. Those that are free are still told of."""

import math

from touchstone_test import AUGMENTED, MULTIPLIERS, STEPS, below, check, finish, folder, relative, run

OUTPUT = "subsection Output\n  set VTU interval = 0\nend\n"
BEAM = """subsection Body beam
  subsection Geometry
    set Type = box
    set Upper corner = 10, 0.5, 0.5
    set Cells = {cells}, 1, 1
  end
  subsection Material
    set Young modulus = 10000
    set Poisson ratio = 0
    set Law = {law}
  end
  {more}
end
"""
DEGREE = "subsection Discretisation\n  set Degree = 2\nend\n"


def point(name, place, boundary, settings):
    """A reference point that is tied to an end of the beam."""
    return (f"subsection Obstacle {name}\n  set Shape = reference point\n  set Reference point = {place}\n"
            f"{settings}end\nsubsection Contact pair {name}\n  set Slave body = beam\n"
            f"  set Slave boundaries = {boundary}\n  set Obstacle = {name}\n  set Behaviour = tied\nend\n")


# A cantilever that a force beside its end bends and twists by most of a right angle: the number of steps, some of
# which are cut, does not count.
(folder / "offset.prm").write_text(
    "set Bodies = beam\nset Obstacles = end\nset Contact pairs = end\n"
    + BEAM.format(cells=4, law="St. Venant-Kirchhoff", more="set Fixed = left") + DEGREE
    + point("end", "11, 2.25, -0.75", "right", "  set Free directions = x, y, z, about x, about y, about z\n"
            "  set Force z = 1.5*t\n") + OUTPUT, encoding="utf-8")
offset = [run(f"offset_{steps}", "offset.prm", {STEPS: steps}) for steps in (12, 6)]
ways = [[result.column(f"obstacle end: displacement {axis}")[-1] for axis in "xyz"] for result in offset]
for way in ways[1:]:
    below("displacement in other steps", math.dist(way, ways[0]) / math.hypot(*ways[0]), 1e-6)

# A beam on two hinges under a pressure p turns at its ends by p b L^3 / 24 E I.
(folder / "hinged.prm").write_text(
    "set Bodies = beam\nset Obstacles = one, two\nset Contact pairs = one, two\n"
    + BEAM.format(cells=10, law="linear elastic", more="set Boundary conditions = top\n  subsection Boundary top\n"
                  "    set Pressure = 0.001*t\n    set Pressure follows = nothing\n  end") + DEGREE
    + point("one", "0, 0.25, 0.25", "left", "  set Free directions = about y\n")
    + point("two", "10, 0.25, 0.25", "right", "  set Free directions = x, about y\n") + OUTPUT, encoding="utf-8")
hinged = [run(f"hinged_{name}", "hinged.prm", {STEPS: 1, **settings})
          for name, settings in (("elimination", {}), ("augmented", AUGMENTED))]
angle = 0.001 * 0.5 * 10**3 / 24 / (10000 * 0.5**4 / 12)
for result in hinged:
    below(f"{result}: angle", relative(abs(math.radians(result.column("obstacle one: rotation y")[-1])), angle), 1e-3)
    below(f"{result}: other angle", relative(result.column("obstacle one: rotation y")[-1],
                                             -result.column("obstacle two: rotation y")[-1]), 1e-6)

# A block that a plate flattens pushes another plate aside, which a thousandth of the force presses against it.
PLATES = """set Bodies = block
set Obstacles = upper, side
set Contact pairs = upper, side
subsection Body block
  set Fixed = left
  set Symmetry = bottom
  subsection Geometry
    set Type = box
    set Upper corner = {length}, {length}, {half}
    set Cells = 3, 3, 2
  end
  subsection Material
    set Law = linear elastic
    set Young modulus = {modulus}
    set Poisson ratio = 0.3
  end
end
subsection Obstacle upper
  set Shape = plane
  set Point = 0, 0, {half}
  set Direction = 0, 0, -1
  set Motion z = -0.008*{half}*t
end
subsection Obstacle side
  set Shape = plane
  set Point = {length}, 0, 0
  set Direction = -1, 0, 0
  set Free directions = x
  set Force x = {force}
end
subsection Contact pair upper
  set Slave body = block
  set Slave boundaries = top
  set Obstacle = upper
end
subsection Contact pair side
  set Slave body = block
  set Slave boundaries = right
  set Obstacle = side
end
"""
ways = []
for name, length, modulus in ("plain", 1, 1000), ("units", 1e-3, 1e12):
    load = 1e-5 * modulus * length**2
    (folder / f"{name}.prm").write_text(PLATES.format(length=length, half=length / 2, modulus=modulus, force=-load) + OUTPUT,
                                        encoding="utf-8")
    for steps, ranks in (1, 1), (2, 1), (2, 2), (4, 1):
        pushed = run(f"{name}_{steps}_{ranks}", f"{name}.prm", {STEPS: steps}, ranks)
        below(f"{pushed}: balance", relative(pushed.column("obstacle side: force x")[-1], load), 1e-7)
        ways.append(pushed.column("obstacle side: displacement x")[-1] / length)
for way in ways[1:]:
    below("way of the plate that is pushed aside", relative(way, ways[0]), 1e-6)

# The same between plates with friction, of which forces move the upper one: three unknowns, and friction is cautious.
RUBS = "  set Behaviour = coulomb\n  subsection Friction\n    set Coefficient = 0.5\n  end\nend\n"
(folder / "rubs.prm").write_text(
    PLATES.format(length=1, half=0.5, modulus=1000, force="-0.01-2*max(t-1,0)")
    .replace("  set Fixed = left\n  set Symmetry = bottom\n", "").replace("upper, side", "upper, side, lower")
    .replace("  set Motion z = -0.008*0.5*t\n", "  set Free directions = x, z\n  set Force x = 2*max(t-1,0)\n"
             "  set Force z = -10*min(t,1)\n")
    .replace("  set Slave boundaries = top\n  set Obstacle = upper\nend\n",
             "  set Slave boundaries = top\n  set Obstacle = upper\n" + RUBS)
    + "subsection Obstacle lower\n  set Shape = plane\n  set Point = 0, 0, 0\n  set Direction = 0, 0, 1\nend\n"
    "subsection Contact pair lower\n  set Slave body = block\n  set Slave boundaries = bottom\n  set Obstacle = lower\n"
    + RUBS + "subsection Load stepping\n  set End time = 2\n  set Steps = 8\nend\n" + OUTPUT, encoding="utf-8")
rubs = [run(f"rubs_{name}", "rubs.prm", settings)
        for name, settings in (("elimination", {}), ("multipliers", MULTIPLIERS), ("augmented", AUGMENTED))]
for result in rubs:
    below(f"{result}: balance", relative(result.column("obstacle side: force x")[-1], 2.01), 1e-7)
    below(f"{result}: way", relative(result.column("obstacle side: displacement x")[-1],
                                     rubs[0].column("obstacle side: displacement x")[-1]), 1e-5)

# Pulled away from the block it is free; half the step does not help, and no more is tried.
free = run("free", "plain.prm", {"Obstacle side/Force x": "0.01"}, fails=True)
check("nothing resists the motion of the obstacle 'side' along 'x'" in free.log and "cut 1 times" in free.log,
      f"{free}: {free.log[-600:]}")
finish()
