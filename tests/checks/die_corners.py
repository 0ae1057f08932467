# SPDX-License-Identifier: LGPL-2.1-or-later
"""A block in the corner of an STL die, where nodes touch two walls or three: each wall carries what a plane in
its place does, with and without friction, inside of a box too, on two ranks; as a whole the die has no solution,
and the message names the corner and the remedy. Friction there converges by all exact enforcements where forces
move the die, and where a block is thrown into the corner."""
# ctest: label = quick

from touchstone_test import STEPS, below, check, checks, finish, folder, relative, run, same, stopped_and_resumed

SCENE = (checks / "die_with_corner.prm").read_text(encoding="utf-8")
FLOOR, WALL = "floor", "wall"
FRICTION = {"Contact pair {}/Behaviour": "coulomb", "Contact pair {}/Friction/Coefficient": "0.3"}


def write_stl(name, triangles):
    """Of triangles that look outwards; readers take normals from the corners."""
    lines = [f"solid {name}"]
    for corners in triangles:
        lines += ["facet normal 0 0 0", "outer loop", *(f"vertex {x} {y} {z}" for x, y, z in corners), "endloop",
                  "endfacet"]
    (folder / f"{name}.stl").write_text("\n".join([*lines, f"endsolid {name}\n"]), encoding="utf-8")


def prism(outline, low, high, caps):
    """Triangles of the outline in x and z, counter-clockwise as seen from y = -infinity, from y = low to high."""
    def square(a, b, c, d):
        return [(a, b, c), (a, c, d)]

    triangles = []
    for (x, z), (u, w) in zip(outline, outline[1:] + outline[:1]):
        triangles += square((x, low, z), (x, high, z), (u, high, w), (u, low, w))
    for cap in caps:
        triangles += square(*((x, low, z) for x, z in cap)) + square(*((x, high, z) for x, z in reversed(cap)))
    return triangles


def friction_of(*pairs):
    return {key.format(pair): value for pair in pairs for key, value in FRICTION.items()}


def without_top(text):
    """The scene without what moves the block."""
    top = SCENE[SCENE.index("  subsection Boundary top"):SCENE.index("end\n\nsubsection Obstacle")]
    return text.replace("set Boundary conditions = top", "").replace(top, "")


def planes(friction):
    """The same scene with a plane for each wall."""
    text = SCENE[:SCENE.index("subsection Obstacle")] + SCENE[SCENE.index("subsection Output"):]
    text = text.replace("Obstacles     = die", "Obstacles     = floor, wall")
    text = text.replace("Contact pairs = contact", "Contact pairs = floor, wall")
    for name, direction in (FLOOR, "0, 0, 1"), (WALL, "1, 0, 0"):
        text += (f"subsection Obstacle {name}\nset Shape = plane\nset Point = 0, 0, 0\nset Direction = {direction}\nend\n"
                 f"subsection Contact pair {name}\nset Slave body = block\nset Slave boundaries = bottom, left\n"
                 f"set Obstacle = {name}\nend\n")
    (folder / "planes.prm").write_text(text, encoding="utf-8")
    return run(f"planes_{friction}", "planes.prm", friction_of(FLOOR, WALL) if friction else {})


# A floor of which the wall at x = 0 is a part; and a box around the block.
OUTLINE = [(-1, -1), (3, -1), (3, 0), (0, 0), (0, 3), (-1, 3)]
write_stl("die", prism(OUTLINE, -1, 2, [[(-1, -1), (3, -1), (3, 0), (0, 0)], [(-1, -1), (0, 0), (0, 3), (-1, 3)]]))
BOX = [(0, 0), (3, 0), (3, 3), (0, 3)]
write_stl("box", prism(BOX, 0, 1, [BOX]))
(folder / "die.prm").write_text(SCENE, encoding="utf-8")

for friction in False, True:
    exact = planes(friction)
    wanted = sorted(map(tuple, (exact.force(FLOOR), exact.force(WALL))))
    settings = friction_of("contact") if friction else {}
    for ranks in 1, 2:
        die = run(f"die_{friction}_{ranks}", "die.prm", settings, ranks)
        found = sorted(map(tuple, (die.force("contact wall 1"), die.force("contact wall 2"))))
        for one, other in zip(found, wanted):
            below(f"{die}, force on a wall", max(abs(a - b) for a, b in zip(one, other)) / 30, 1e-9)

# A run that goes on from a checkpoint has the faces and the friction of each wall.
rubbed = friction_of("contact")
same(run("in_steps", "die.prm", {**rubbed, STEPS: 4}),
     stopped_and_resumed("stopped", folder / "die.prm", {**rubbed, STEPS: 4}, 2, ranks=2), 1e-9)

# Three walls of the inside of a box: also those beside the block, which would bulge by the Poisson effect.
box = run("box", "die.prm", {"Obstacle die/File": "box.stl", "Obstacle die/Side": "inside",
                             "Contact pair contact/Slave boundaries": "bottom, left, front, back"})
forces = [box.force(f"contact wall {k}") for k in (1, 2, 3)]
below("box, forces on opposite walls differ", min(abs(force[1]) for force in forces), 1e-6)
for axis in 0, 2:
    total = sum(force[axis] for force in forces)
    below(f"box, balance along {'xyz'[axis]}", relative(-total, box.reaction("block", "top")[axis]), 1e-8)
    check(total > 10, f"box: force {total} along {'xyz'[axis]}")

# Forces move the die, whose floor could carry both by friction: nodes one face away from the wall, where another
# formulation of friction begins, must not change it from iterate to iterate.
MOVED = {**rubbed, "Body block/Fixed": "top", "Obstacle die/Free directions": "x, y, z",
         "Obstacle die/Reference point": "0.5, 0.5, 0", "Obstacle die/Force x": "5*t", "Obstacle die/Force y": "0.5*t",
         "Obstacle die/Force z": "20*t"}
(folder / "moved.prm").write_text(without_top(SCENE), encoding="utf-8")
# One face away, and 0.7 faces, where the other formulation begins.
for cells, corner in ("4, 4, 4", "1, 1, 1"), ("4, 1, 4", "1, 1, 1"), ("4, 2, 4", "1, 1.02049, 1"):
    name = "moved_" + cells.replace(", ", "_")
    settings = {**MOVED, STEPS: 2, "Body block/Geometry/Cells": cells, "Body block/Geometry/Upper corner": corner}
    one = run(f"{name}_elimination", "moved.prm", {**settings, "Contact/Enforcement": "elimination"})
    for enforcement in "lagrange multipliers", "augmented lagrange":
        same(one, run(f"{name}_{enforcement}", "moved.prm", {**settings, "Contact/Enforcement": enforcement}), 1e-6)
    same(one, run(f"{name}_ranks", "moved.prm", settings, 2), 1e-9)

# A block that is thrown into the corner, and out of it again: friction takes energy, nothing gives it.
(folder / "thrown.prm").write_text(without_top((folder / "planes.prm").read_text(encoding="utf-8")), encoding="utf-8")
THROWN = friction_of(FLOOR, WALL)
THROWN.update({"Time integration/Scheme": "contact_stabilized", "Load stepping/End time": 1, STEPS: 100,
               "Body block/Geometry/Lower corner": "0.2, 0, 0.3", "Body block/Geometry/Upper corner": "1.2, 1, 1.3",
               "Body block/Geometry/Cells": "3, 3, 3", "Body block/Material/Law": "neo-Hookean",
               "Body block/Material/Density": 1, "Body block/Initial velocity x": -1,
               "Body block/Initial velocity y": 0.3, "Body block/Initial velocity z": -1.5})
energies = []
for enforcement in "elimination", "lagrange multipliers", "augmented lagrange":
    rows = run(f"thrown_{enforcement}", "thrown.prm", {**THROWN, "Contact/Enforcement": enforcement}).rows()
    energies.append(rows[-1]["energy: kinetic"] + rows[-1]["energy: strain"])
    check(0.5 < energies[-1] / 1.67 < 1 and rows[-1]["energy: friction"] > 0, f"thrown: energy {energies[-1]}")
    below(f"thrown, {enforcement}, energy", relative(energies[-1], energies[0]), 1e-4)

whole = run("whole", "die.prm", {"Obstacle die/Walls": "whole"}, fails=True)
check("obstacle 'die' has sharp edges that look inwards" in whole.log and "set its 'Walls' to 'separate'" in whole.log,
      f"whole: {whole.log[-600:]}")
finish()
