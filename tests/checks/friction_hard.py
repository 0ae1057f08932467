# SPDX-License-Identifier: LGPL-2.1-or-later
"""Friction where slave nodes have less freedom than others or slip reverses. Every exact enforcement
and both pairings converge to one answer."""

import math

from touchstone_test import (AUGMENTED, DEGREE, ENFORCEMENT, ENFORCEMENTS, EXACT_ENFORCEMENTS, GAP, MULTIPLIERS,
                             below, check, checks, finish, relative, run, same)

# Stick beside a plane of symmetry, on meshes that do not match.
for pairing in "averaged", "pointwise":
    settings = {"Contact pair c/Pairing": pairing}
    washer = run(f"washer_{pairing}", checks / "friction_beside_symmetry.prm", settings)
    for name, enforcement in ("multipliers", MULTIPLIERS), ("augmented", AUGMENTED):
        same(washer, run(f"washer_{pairing}_{name}", checks / "friction_beside_symmetry.prm",
                         {**settings, **enforcement}), 1e-6)

# Slave nodes with a prescribed displacement along the slip: F / G = mu, but for the dents in the base, whose slopes are
# those of the pressure over Young's modulus: 1e-7 as shipped, a hundredth of it with bodies a hundred times as stiff.
# G = 6 * 4 * 4, mu = 0.1.
stiff = {f"Body {body}/Material/Young modulus": 1e7 for body in ("base", "block")}
for pairing in "pointwise", "averaged":
    answer = None
    for enforcement in ENFORCEMENTS:
        settings = {"Contact pair slope/Pairing": pairing, ENFORCEMENT: enforcement}
        driven = run(f"driven_{pairing}_{enforcement}", checks / "friction_driven_nodes.prm", settings)
        force = driven.force("slope")[0]
        answer = force if answer is None else answer
        below(f"{driven}, force {force} differs from -9.6", relative(force, -9.6), 3e-7)
        below(f"{driven}, force {force} differs from {answer}", relative(force, answer), 1e-8)
        below(f"{driven}, force {force} and reaction", relative(-force, driven.reaction("block", "left")[0]), 1e-8)
        force = run(f"driven_stiff_{pairing}_{enforcement}", checks / "friction_driven_nodes.prm",
                    {**settings, **stiff}).force("slope")[0]
        below(f"driven, stiff, {pairing}, {enforcement}, force {force} differs from -9.6", relative(force, -9.6), 1e-8)
# A block at rest on a slope that only the coefficient of rest can hold. Before, its nodes began in slip and never came to
# know that coefficient (exit code 2).
for name, settings in ("exact", {}), ("regularised", {"Contact/Friction": "regularised"}), *(
        (e, {ENFORCEMENT: e}) for e in ENFORCEMENTS):
    slope = run(f"slope_{name}", checks / "block_on_slope.prm", settings)
    check(slope.column("contact: slip nodes")[-1] == 0, f"{slope}: nodes slide")
    below(f"{slope}, friction holds the weight", relative(slope.force("contact")[0], -0.3420201433256687 / 2), 1e-8)
run("slope_too_steep", checks / "block_on_slope.prm", {"Contact pair contact/Friction/Static coefficient": 0.36}, fails=True)
# Far from the origin, where positions have a round-off of 1e-6 of the slip.
far = "1e5, 2e5, -1e5"
below("driven, far away, force", relative(run(
    "driven_far_away", checks / "friction_driven_nodes.prm",
    {"Body base/Geometry/Move": far, "Body block/Geometry/Move": far}).force("slope")[0], answer), 1e-6)

# Supports move slave and master nodes past each other: they slide with all of their friction, however
# little they slide, and the rest follows the motion.
motion = "Body upper/Boundary left/Displacement x"
answer = None
for enforcement in EXACT_ENFORCEMENTS:
    for size in 1e-7, 1e-6:
        force = run(f"forced_{enforcement}_{size}", checks / "friction_forced_slip.prm",
                    {ENFORCEMENT: enforcement, motion: f"{size}*t"}).force("contact")[0]
        answer = force if answer is None else answer
        below(f"forced slip {size}, {enforcement}, force {force} differs from {answer}",
              relative(force, answer), 1e-3 if size > 2e-7 else 1e-6)

# A block that one slave node and its friction hold: the shift that keeps the first increments finite vanishes with
# the residual, or Newton's method would converge by a constant factor.
answer = None
for enforcement in EXACT_ENFORCEMENTS:
    # It sinks in beside that node: the run says that this is no result, with the same depth and place.
    rocking = run(f"rocking_{enforcement}", checks / "rocking_block.prm", {ENFORCEMENT: enforcement}, fails=True)
    reason = rocking.summary["failure"]
    answer = reason if answer is None else answer
    check("more than a fifth of a slave face" in reason and reason == answer, f"{rocking}: {reason}; {answer}")
    check(rocking.iterations() <= 15, f"{rocking}: {rocking.iterations()} iterations")

# Edges of slave and master that lie almost on each other: where along them they cross must not matter.
bolt = run("bolt", checks / "friction_bolt.prm")
for name, enforcement in ("multipliers", MULTIPLIERS), ("augmented", AUGMENTED):
    result = run(f"bolt_{name}", checks / "friction_bolt.prm", enforcement)
    same(bolt, result, 1e-6)
    check(result.iterations() <= 25, f"{result}: {result.iterations()} iterations")

# Planes of symmetry that the master does not have are rollers: friction acts across them as where a displacement is
# prescribed. The normal of the table is exact.
rollers = checks / "friction_rollers.prm"
prescribed = {"Body sleeve/Symmetry": "first cut, second cut", "Body sleeve/Boundary end/Displacement z": "0"}
for pairing in "averaged", "pointwise":
    settings = {"Contact pair fit/Pairing": pairing}
    answer = run(f"prescribed_{pairing}", rollers, {**settings, **prescribed})
    for enforcement in EXACT_ENFORCEMENTS:
        result = run(f"rollers_{pairing}_{enforcement}", rollers, {**settings, ENFORCEMENT: enforcement})
        below(f"{result}, block", relative(result.force("rest")[0], 6.0), 1e-8)
        below(f"{result}, sleeve", relative(result.force("fit")[2], answer.force("fit")[2]), 1e-6)
same(answer, run("rollers_2_ranks", rollers, {**settings, **prescribed}, ranks=2), 1e-8)

# Rollers that are oblique to the contact face of their body: the force on the edge is normal to the face, and what presses
# on the inside of a face beside it is met. With the same plane in the punch, too, it is a plane of symmetry, and the bodies
# have ridges there.
oblique, ball = checks / "oblique_roller.prm", checks / "oblique_roller_ball.prm"
ridge = {"Body punch/Symmetry": "left", "Body punch/Boundary back/Displacement x": "-0.007*t",
         "Body punch/Geometry/Corners": "0.7, 1, -0.2; 0.78, 1, -0.2; 1.06, 1.4, -0.2; 0.98, 1.4, -0.2"}
forces = [run(f"oblique_{name}", oblique, settings).force("contact")[1] for name, settings in (("roller", {}), ("ridge", ridge))]
below(f"punch on an oblique roller and on a ridge, forces {forces}", relative(*forces), 0.05)
forces = [run(f"oblique_ball_{number}", ball, {"Body block/Symmetry": supports}).force("contact")[1]
          for number, supports in enumerate(("left, front, bottom, right", "front, bottom, right"))]
below(f"ball beside an oblique roller, forces {forces} with it and without", relative(*forces), 0.1)

# Supports hold 13 slave nodes of a ring, on 7 master nodes, which cannot follow all of them. Forces grow until some slide;
# before, the run ended where they had not yet grown enough (exit code 2).
rings = [run(f"ring_{e}", checks / "friction_ring.prm", {ENFORCEMENT: e}) for e in EXACT_ENFORCEMENTS]
for other in rings[1:]:
    same(rings[0], other, 1e-7)
check(rings[0].column("fit: slip nodes")[-1] > 0, "ring: no node slides")
# With a limit that no force reaches there is no solution, and the log says why.
ring = run("ring", checks / "friction_ring.prm", {"Contact pair fit/Friction/Shear strength": 2000}, fails=True)
check(ring.code == 2, f"ring: exit code {ring.code}")
ring.says("exchange slave and master, or refine the master surface")
run("ring_exchanged", checks / "friction_ring.prm",
    {"Contact pair fit/Slave body": "outer", "Contact pair fit/Slave boundaries": "inner",
     "Contact pair fit/Master body": "inner", "Contact pair fit/Master boundaries": "outer"})

# A slave edge in the corner of two obstacles: what part of the force there is friction does not
# depend on the enforcement. (The default tolerance of gaps is 5e-6 of the pressure there.)
for degree in 1, 2:
    settings = {DEGREE: degree, GAP: 1e-10}
    corner = run(f"corner_{degree}", checks / "friction_corner.prm", settings)
    same(corner, run(f"corner_{degree}_multipliers", checks / "friction_corner.prm",
                     {**settings, **MULTIPLIERS}), 1e-8)
    same(corner, run(f"corner_{degree}_augmented", checks / "friction_corner.prm",
                     {**settings, **AUGMENTED}), 1e-6)

# A belt on the cone from end to end, whose slip reverses: T2 / T1 = exp(mu pi / 2). Its forces are
# small beside the stiffness of its cells, so that a gap left by linearisation must not open its rows.
belt = run("belt", checks / "friction_belt.prm")
tension = belt.reaction("belt", "first cut")[1]
below(f"belt, T2 = {tension} differs from exp(mu pi / 2)",
      relative(-tension, math.exp(0.1 * math.pi)), 2e-3)
below("belt, steps cut", belt.cuts(), 0.5)
# A plastic tube that is widened beyond its yield strain in one step.
fit = run("fit", checks / "plastic_fit.prm", {GAP: 1e-10})
same(fit, run("fit_multipliers", checks / "plastic_fit.prm", {GAP: 1e-10, **MULTIPLIERS}), 1e-6)
finish()
