# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points inside slave faces with friction and plasticity, whose state goes on from step to step: mirror
images, ranks, enforcements, a restart, and finer steps."""
# ctest: label = quick

from touchstone_test import (AUGMENTED, MULTIPLIERS, STEPS, below, check, finish, folder, relative, run,
                             stopped_and_resumed)

# The lowest of the faces of half a tube, which is the slave, is wider than its contact: its point, in
# the middle, has equal weights of nodes on both sides.
SCENE = """
set Bodies = low, tube
set Contact pairs = c
subsection Body low
  set Fixed = bottom
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
subsection Body tube
  set Boundary conditions = first cut, second cut
  {first cut}{second cut}subsection Geometry
    set Type = tube
    set Axis = x
    set Origin = 0.05, 0, 0.5
    set Start = -0.3
    set End = 0.3
    set Inner radius = 0.25
    set Outer radius = 0.5
    set First angle = 180
    set Angle = 180
    set Cells = 2, 7, 2
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.37
  end
end
subsection Contact pair c
  set Slave body = tube
  set Slave boundaries = outer
  set Master body = low
  set Master boundaries = top
  set Behaviour = coulomb
  subsection Friction
    set Coefficient = 0.95
  end
end
subsection Load stepping
  set End time = 3
  set Steps = 6
end
"""
PLASTIC = {"Body tube/Material/Law": "small-strain von Mises",
           **{f"Body tube/Material/Plasticity/{key}": value for key, value in (
               ("Hardening", "linear"), ("Yield stress", 5), ("Hardening modulus", 100))}}
REGULARISED = {"Contact/Friction": "regularised", "Contact/Enforcement": "lagrange multipliers"}
# A cylinder across the faces of a box: many places under it are nearly as deep, and which of two faces has
# the deeper point decides which nodes have their rows.
RIDGE = """
set Bodies = low
set Obstacles = punch
set Contact pairs = c
subsection Body low
  set Fixed = {fixed}
  subsection Geometry
    set Type = box
    set Lower corner = {lower}
    set Upper corner = {upper}
    set Cells = 3, 3, 3
  end
  subsection Material
    set Law = St. Venant-Kirchhoff
    set Young modulus = 1000
    set Poisson ratio = 0
  end
end
subsection Obstacle punch
  set Shape = cylinder
  set Point = {point}
  set Direction = {direction}
  set Radius = 0.9
  set Motion x = {x} {motion}
  set Motion y = 0.157 {motion}
  set Motion z = {z} * min(1, t)
end
subsection Contact pair c
  set Slave body = low
  set Slave boundaries = {top}
  set Obstacle = punch
  set Behaviour = coulomb
  subsection Friction
    set Coefficient = {coefficient}
  end
end
subsection Load stepping
  set End time = 3
  set Steps = 6
end
"""
MOTION = "* (min(1, max(0, t - 1)) - 1.5 * max(0, t - 2))"


def written(sign):
    """The scene, or with -1 its image in the plane y = 0."""
    boundary = """subsection Boundary {name}
    set Displacement x = 0.004 {motion}
    set Displacement y = {y} {motion}
    set Displacement z = -0.003 * min(1, t)
  end
  """
    text = SCENE
    for name in "first cut", "second cut":
        text = text.replace(f"{{{name}}}",
                            boundary.format(name=name, motion=MOTION, y=sign * 0.006))
    file = f"tube{'' if sign > 0 else '_mirrored'}.prm"
    (folder / file).write_text(text, encoding="utf-8")
    return file


def ridge(name, signs, coefficient):
    """The cylinder on the box, mirrored in the axes with -1 in @p signs (y is none of them)."""
    def vector(*v):
        return ", ".join(str(s * c) for s, c in zip(signs, v))

    up = signs[2] > 0
    corners = vector(-1.294, -1.243, -1.053), vector(1.294, 1.243, 0)
    lower, upper = (", ".join(str(f(float(a), float(b))) for a, b in zip(*(c.split(",") for c in corners)))
                    for f in (min, max))
    (folder / f"{name}.prm").write_text(
        RIDGE.format(fixed="bottom" if up else "top", top="top" if up else "bottom", lower=lower,
                     upper=upper, point=vector(-0.2844, -0.0325, 0.9), direction=vector(1, 1, 0),
                     x=signs[0] * 0.194, z=signs[2] * -0.01974, motion=MOTION,
                     coefficient=coefficient), encoding="utf-8")
    return f"{name}.prm"


def forces(result, signs=(1, 1, 1)):
    """Of each step, x, y, z."""
    columns = [result.column(f"c: force {axis}") for axis in "xyz"]
    return [tuple(s * f for s, f in zip(signs, force)) for force in zip(*columns)]


def difference(a, b):
    """Largest difference of two such lists, relative."""
    size = max(max(map(abs, force)) for force in a)
    return max(abs(x - y) for one, two in zip(a, b) for x, y in zip(one, two)) / size


scene, image = written(1), written(-1)
for name, settings in (("elastic", {}), ("plastic", PLASTIC), ("regularised", REGULARISED)):
    one = run(name, scene, settings)
    check(one.contact("c", "area") == 0 and one.contact("c", "active") > 0, f"{name}: no points")
    mirrored = run(f"{name}_mirrored", image, settings)
    below(f"{name}: mirrored", difference(forces(one), forces(mirrored, (1, -1, 1))), 1e-7)
    for other, more, ranks, bound in (("ranks", {}, 2, 1e-7), ("multipliers", MULTIPLIERS, 1, 1e-7),
                                      ("augmented", AUGMENTED, 1, 1e-5)):
        if name == "regularised" and more:
            continue
        result = run(f"{name}_{other}", scene, {**settings, **more}, ranks=ranks)
        below(f"{name}, {other}", difference(forces(one), forces(result)), bound)
    # Stopped before the last step, and resumed.
    resumed = stopped_and_resumed(name, scene, settings, every=1, ranks=2)
    below(f"{name}: resumed", difference(forces(one), forces(resumed)), 1e-7)

# With more friction the points stick, and are held by springs, whose stiffness is that of nodes.
for coefficient in (0.1, 0.8):
    one = run(f"ridge_{coefficient}", ridge("ridge", (1, 1, 1), coefficient))
    # In the first step; later nodes carry, too.
    check(one.column("c: area")[0] == 0 and one.column("c: active nodes")[0] > 1, "ridge: no points")
    for axis, signs in (("x", (-1, 1, 1)), ("z", (1, 1, -1))):
        mirrored = run(f"ridge_{coefficient}_{axis}", ridge(f"ridge_{axis}", signs, coefficient))
        below(f"ridge, {coefficient}: mirrored in {axis}",
              difference(forces(one), forces(mirrored, signs)), 1e-7)

# Where the contact slides from one face to the next, a point that has pressed is not given up for one that
# is a little deeper: the force would go to and fro with the steps, by half.
fine = [run(f"steps_{n}", scene, {**PLASTIC, STEPS: n}) for n in (12, 24)]
below("plastic: 12 and 24 steps", relative(fine[0].force("c")[2], fine[1].force("c")[2]), 0.1)
finish()
