# SPDX-License-Identifier: LGPL-2.1-or-later
# ctest: goldens = pressed_sphere, pressed_sphere.mpirun=2
"""Obstacles that forces move: a sphere pressed by a force is the one that is driven as far, with each
enforcement and solver; its force is in balance; a plate that a moment turns against friction, and what
friction cannot hold; momentum of a plate that falls on a free block, implicit and explicit, on two ranks
and after a restart; a spinning top keeps its angular momentum; boundaries that are tied to a reference
point move as rigid bodies, against the theory of beams."""

import math
import shutil

from touchstone_test import (AUGMENTED, CG, GMRES, MULTIPLIERS, PENALTY, STEPS, below, check, checks, finish,
                             golden, launch, relative, run, same, tests)

# A sphere under a force, and the same driven to where the force has moved it.
BALL = "Obstacle ball/"
sphere = tests / "pressed_sphere.prm"
pressed = golden("pressed_sphere")
same(pressed, golden("pressed_sphere", 2), 1e-7)


def balanced(result, bound=1e-8):
    """The bodies have the force of each step."""
    for time, on_ball, on_block in zip(result.column("time"), result.column("obstacle ball: force z"),
                                       result.column("contact: force z")):
        below(f"{result}: balance at {time}", relative(on_ball, 2 * time) if time else 0., bound)
        check(on_ball == -on_block, f"{result}: action and reaction: {on_ball}, {on_block}")


balanced(pressed)
way = pressed.column("obstacle ball: displacement z")
driven = run("driven", sphere, {BALL + "Free directions": "", BALL + "Force z": "",
                                BALL + "Motion z": f"{way[-1]!r}*t"})
below("force of the driven sphere", relative(driven.force("contact")[2], -2), 1e-7)
for name, settings, bound in (("multipliers", MULTIPLIERS, 1e-7), ("augmented", AUGMENTED, 1e-7),
                              ("cg", CG, 1e-6), ("gmres", GMRES, 1e-6),
                              ("consistent", {"Contact/Linearisation": "consistent"}, 1e-7)):
    other = run(name, sphere, settings)
    balanced(other)
    below(f"{name}: displacement", relative(other.column("obstacle ball: displacement z")[-1], way[-1]), bound)
balanced(run("penalty", sphere, PENALTY))
balanced(run("friction", sphere, {"Contact pair contact/Behaviour": "coulomb",
                                  "Contact pair contact/Friction/Coefficient": "0.2"}))

# A step that is cut begins again from where the sphere was.
HARD = {"Body block/Material/Law": "neo-Hookean", BALL + "Force z": "-300*t"}
one, four = (run(f"hard_{steps}", sphere, {**HARD, STEPS: steps}) for steps in (1, 4))
check(one.cuts() > 0, f"{one}: no step was cut")
below("displacement after a cut", relative(one.column("obstacle ball: displacement z")[-1],
                                           four.column("obstacle ball: displacement z")[-1]), 1e-7)
# Meshes that change take it along.
below("displacement with adaptive meshes", relative(
    run("adaptive", sphere, {"Refinement/Estimator": "recovered stress", "Refinement/Cycles": 2})
    .column("obstacle ball: displacement z")[-1],
    run("fine", sphere, {"Discretisation/Refinement factor": 2}).column("obstacle ball: displacement z")[-1]), 0.02)

# A plate that friction holds against a moment and a force along it turns by half a degree. Far away, where all
# nodes slide along their chords, there are other balances: in three steps it turned by 134 degrees, in five by 279.
turns = [run(f"held_{steps}_{ranks}", checks / "plate_held_by_friction.prm", {STEPS: steps}, ranks)
         .column("obstacle plate: rotation z")[-1] for steps, ranks in ((1, 1), (3, 1), (5, 1), (5, 2))]
below("turn of a held plate, degrees", relative(turns[0], 0.494), 1e-3)
for turn in turns[1:]:
    below("the same in more steps", relative(turn, turns[0]), 1e-6)

# A slab moves below a roller that turns freely, in steps that are cut until nodes stick: then it turns by the way
# over its radius, but for the strain of the slab, and the friction has no moment about its axis.
rolled = run("rolled", checks / "roller_on_table.prm")
check(rolled.cuts() > 0, f"{rolled}: no step was cut")
below("rotation of the roller", relative(math.radians(rolled.column("obstacle roller: rotation y")[-1]),
                                         -0.02 / 3), 0.03)
below("friction on the roller", abs(rolled.force("contact")[0]), 1e-2)


def resumes(name, scene, settings, steps):
    """The same statistics after a checkpoint."""
    settings = {"Checkpoints/Steps between": steps, **settings}
    whole = run(name, scene, settings)
    text = (whole.folder / "statistics").read_text(encoding="utf-8")
    for folder in sorted(whole.folder.glob("checkpoint_*"))[1:]:
        shutil.rmtree(folder)
    options = [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
    again = launch("--results-only", "--resume", "--output", name, *options,
                   "--set", "Output/VTU interval=0", scene)
    check(again.returncode == 0, f"{name} resumed: {again.stdout}")
    check((whole.folder / "statistics").read_text(encoding="utf-8") == text, f"{name} resumed: other statistics")


resumes("resumed", sphere, {STEPS: 3}, 1)

# A plate turned by a moment against friction, and driven by the same angle.
plate = checks / "plate_under_moment.prm"
PLATE = "Obstacle plate/"
turned = run("turned", plate, {STEPS: 1})
angle = turned.column("obstacle plate: rotation z")[-1]
check(0 < angle < 1, f"the plate turns by {angle}")
below("moment of the turned plate", relative(turned.column("obstacle plate: moment z")[-1], -2), 1e-8)
below("force of the turned plate", relative(turned.column("obstacle plate: force z")[-1], 40), 1e-8)
driven = run("driven_turn", plate, {STEPS: 1, PLATE + "Free directions": "z", PLATE + "Moment z": "",
                                    PLATE + "Reference point": "0,0,0", PLATE + "Rotate angle": f"{angle!r}*t"})
below("moment of the driven turn", relative(driven.column("obstacle plate: moment z")[-1], -2), 1e-7)
same(run("turned_2", plate, {STEPS: 1}, 2), turned, 1e-6)
# Friction carries at most about mu F times the mean distance from the axis, 0.77.
slips = run("slips", plate, {PLATE + "Moment z": "25*t", "Load stepping/Maximum cuts": 2}, fails=True)
check("obstacle 'plate'" in slips.text, f"why the plate is not held: {slips.text[-400:]}")

# Momentum of a plate that falls on a free block.
falling = checks / "falling_plate.prm"
EXPLICIT = {"Time integration/Scheme": "central_differences"}
for name, settings, ranks, bound in (
        ("midpoint", {}, 1, 1e-7), ("midpoint_2", {}, 2, 1e-7),
        ("stabilised", {"Time integration/Scheme": "contact_stabilized"}, 1, 1e-7),
        ("explicit", EXPLICIT, 1, 1e-12), ("explicit_2", EXPLICIT, 2, 1e-12),
        ("explicit_penalty", {**EXPLICIT, "Contact/Enforcement": "penalty"}, 1, 1e-12)):
    fall = run(name, falling, settings, ranks)
    total = [0.5 * v + p for v, p in zip(fall.column("obstacle plate: velocity z"), fall.column("momentum z"))]
    below(f"{name}: momentum", max(abs(p + 0.5) for p in total), bound)
    last = fall.column("obstacle plate: velocity z")[-1]
    check(last > -0.7, f"{name}: the plate is not slowed down: {last}")
    check(max(abs(f) for f in fall.column("contact: force z")) > 1, f"{name}: no impact")
first, second = (run(f"bits_{n}", falling, EXPLICIT, n) for n in (1, 2))
check((first.folder / "statistics").read_text(encoding="utf-8") ==
      (second.folder / "statistics").read_text(encoding="utf-8"), "explicit: other bits on two ranks")
resumes("explicit_resumed", falling, EXPLICIT, 8)
resumes("midpoint_resumed", falling, {}, 8)

# A body that a moment turns about all axes, and that touches nothing: Euler's equations, integrated with 30,000 steps of
# Runge-Kutta's method, give 63.794 degrees about x. With moments of both ends in the axes of one it was 60.5.
turning = checks / "turning_freely.prm"
for scheme, settings in (("newmark", {"Impact": "elastic"}), ("hht", {"Impact": "elastic"}), ("contact_stabilized", {}),
                         ("generalized_alpha", {"Spectral radius": 1})):
    freely = run(f"freely_{scheme}", turning, {f"Time integration/{key}": value
                                               for key, value in {"Scheme": scheme, **settings}.items()})
    below(f"{freely}: turn about x", relative(freely.column("obstacle tool: rotation x")[-1], 63.794), 2e-3)

# A top without forces: about its axis of symmetry z it precesses at (I_z - I_x) / I_x omega_z.
TOP = {PLATE + "Free directions": "about x, about y, about z", PLATE + "Inertia": "1, 1, 1.5",
       PLATE + "Initial velocity": "0,0,0", PLATE + "Mass": 0, PLATE + "Initial angular velocity": "1, 0, 20",
       PLATE + "Point": "0, 0, 9"}
for name, settings, bound in (("top", {STEPS: 200}, 2e-3), ("explicit_top", EXPLICIT, 2e-3)):
    top = run(name, falling, {**TOP, **settings})
    spin = [top.column(f"obstacle plate: angular velocity {axis}") for axis in "xyz"]
    # Angular momentum L = (1, 0, 30) stays; the component of omega along it does as well.
    energy = [sum(w * l for w, l in zip(omega, (1, 0, 30))) for omega in zip(*spin)]
    below(f"{name}: energy of the top", max(relative(e, energy[0]) for e in energy), bound)
    # In space omega turns about L at |L| / I_x: at the end by angle, from the plane of x and L to that of
    # y and L.
    last = top.rows()[-1]
    length, angle = math.hypot(1, 30), math.hypot(1, 30) * last["time"]
    along = [energy[0] / length**2 * l for l in (1, 0, 30)]
    across = [first - a for first, a in zip((1, 0, 20), along)]
    third = [across[0] * math.cos(angle), math.hypot(*across) * math.sin(angle), across[2] * math.cos(angle)]
    for axis, component in enumerate(third):
        below(f"{name}: precession, axis {axis}", abs(spin[axis][-1] - along[axis] - component), 1e-3)

# A boundary that is tied to a reference point: a beam that a force stretches, and a moment bends.
beam = checks / "beam_with_rigid_end.prm"
END = "Obstacle end/"
bent = run("bent", beam)
below("stretching", relative(bent.column("obstacle end: displacement x")[-1], 3 * 4 / 1000), 1e-7)
# w = M L^2 / 2 E I and the angle M L / E I, with I = 1 / 12.
below("bending", relative(bent.column("obstacle end: displacement y")[-1], 0.01 * 16 / 2 / 1000 * 12), 1e-3)
below("angle", relative(math.radians(bent.column("obstacle end: rotation z")[-1]), 0.01 * 4 / 1000 * 12), 1e-3)
# The twist of a rigid end draws its nodes together in a law for small rotations, which stiffens the beam: by 10 % at
# 5 degrees. It is told of; a law that turns with the beam has the angle of small moments.
TWIST = {END + "Force x": "", END + "Moment z": "", "Discretisation/Degree": "1", "Body beam/Geometry/Cells": "4, 2, 2"}
twists = {}
for name, moment, law in (("little", 0.01, "linear elastic"), ("linear", 2, "linear elastic"), ("large", 2, "neo-Hookean")):
    twisted = run(f"twisted_{name}", beam, {**TWIST, END + "Moment x": f"{moment}*t", "Body beam/Material/Law": law})
    twists[name] = twisted.column("obstacle end: rotation x")[-1] / moment
    told = any("as a rigid one that has turned" in text for text in twisted.summary["warnings"])
    check(told == (name == "linear"), f"{twisted}: warnings {twisted.summary['warnings']}")
check(relative(twists["linear"], twists["little"]) > 0.05, f"the rigid end does not stiffen the beam: {twists}")
below("twist of a law that turns", relative(twists["large"], twists["little"]), 0.02)
finish()
