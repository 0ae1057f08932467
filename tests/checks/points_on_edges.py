# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plastic bodies whose contact, narrower than the slave faces, begins on an edge between two of them and slides
away: finer steps, mirror images, ranks, enforcements, solvers, a restart."""
# ctest: label = quick

from touchstone_test import (AUGMENTED, GMRES, MULTIPLIERS, STEPS, below, check, finish, folder, relative, run,
                             stopped_and_resumed)

# 978/772 of contrib/fuzz_scenes: half a ball in half a tube, above one of its lines of nodes.
SCENE = """
set Bodies = low, top
set Contact pairs = c
subsection Body low
  set Fixed = outer
  subsection Geometry
    set Type = tube
    set Axis = x
    set Origin = 0, 0, 1.6
    set Start = -1.2
    set End = 1.2
    set Inner radius = 1.6
    set Outer radius = 2.44
    set First angle = 180
    set Angle = 180
    set Cells = 2, 6, 3
  end
  {material}
end
subsection Body top
  set Boundary conditions = z cut
  subsection Boundary z cut
    set Displacement x = 0
    set Displacement y = {y} * max(0, t - 1)
    set Displacement z = -0.03 * min(1, t)
  end
  subsection Geometry
    set Type = ball
    set Centre = 0, 0, 0.76
    set Radius = 0.76
    set Keep = both, both, -
    set Cells = 2, 1
  end
  {material}
end
subsection Contact pair c
  set Slave body = low
  set Slave boundaries = inner
  set Master body = top
  set Master boundaries = surface
  set Pairing = averaged
  set Master normal = smoothed
  set Behaviour = tresca
  subsection Friction
    set Shear strength = 3.7
  end
end
subsection Load stepping
  set End time = 2
  set Steps = 8
end
"""
MATERIAL = """subsection Material
    set Law = small-strain von Mises
    set Young modulus = 1000
    set Poisson ratio = 0
    subsection Plasticity
      set Hardening = linear
      set Yield stress = 5
      set Hardening modulus = 100
    end
  end"""


def written(sign):
    """The scene, or with -1 its image in the plane y = 0."""
    file = f"ball{'' if sign > 0 else '_mirrored'}.prm"
    (folder / file).write_text(SCENE.format(material=MATERIAL, y=sign * 0.024), encoding="utf-8")
    return file


def forces(result, sign=1):
    """Of each step, x, y, z."""
    columns = [result.column(f"c: force {axis}") for axis in "xyz"]
    return [(x, sign * y, z) for x, y, z in zip(*columns)]


def difference(a, b):
    """Largest difference of two such lists, relative."""
    size = max(max(map(abs, force)) for force in a)
    if len(a) != len(b):
        return float("nan")
    return max(abs(x - y) for one, two in zip(a, b) for x, y in zip(one, two)) / size


scene, image = written(1), written(-1)
one = run("one", scene)
check(one.contact("c", "area") == 0 and one.contact("c", "active") > 0, "no points")
# At the ends of the four parts of the run that the coarsest has. A point of one face in the place of that on the
# edge, or two of them, carried 1.2 to 2.2 times as much.
for n in 4, 16, 32:
    steps = run(f"steps_{n}", scene, {STEPS: n})
    for part in 1, 2, 3, 4:
        below(f"{n} steps, part {part}",
              relative(forces(steps)[part * n // 4 - 1][2], forces(one)[2 * part - 1][2]), 0.005)
    mirrored = run(f"steps_{n}_mirrored", image, {STEPS: n})
    below(f"{n} steps, mirrored", difference(forces(steps), forces(mirrored, -1)), 1e-6)
for name, settings, ranks, bound in (("ranks", {}, 2, 1e-7), ("multipliers", MULTIPLIERS, 1, 1e-7),
                                     ("multipliers_ranks", MULTIPLIERS, 2, 1e-7),
                                     ("augmented", AUGMENTED, 1, 1e-5), ("GMRES", GMRES, 1, 1e-6)):
    other = run(name, scene, settings, ranks=ranks)
    below(name, difference(forces(one), forces(other)), bound)
for ranks in 1, 2:
    resumed = stopped_and_resumed(f"resumed_{ranks}", scene, {}, every=5, ranks=ranks)
    below(f"resumed on {ranks} rank(s)", difference(forces(one), forces(resumed)), 1e-7)
finish()
