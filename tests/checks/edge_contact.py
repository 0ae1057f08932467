# SPDX-License-Identifier: LGPL-2.1-or-later
"""Edges that cross, edges that are parallel and a vertex in a face: one answer of all enforcements,
solvers, pairings and roles, symmetry, and what cannot be solved says so."""
# ctest: goldens = crossed_edges, edge_across_edge, vertex_in_slave_face

from touchstone_test import (AUGMENTED, CG, GMRES, MULTIPLIERS, PENALTY, STEPS, below, check, finish,
                             folder, golden, relative, run, same, tests)
from edge_on_edge_scenes import ON_EDGE, block, pressed  # of tests/, which touchstone_test finds

CONSISTENT = {"Contact/Linearisation": "consistent"}
crossed, across, vertex = (golden(name) for name in
                           ("crossed_edges", "edge_across_edge", "vertex_in_slave_face"))
scene = tests / "crossed_edges.prm"

# Right angles: the force is vertical, and the bodies are each other's mirror image.
force = crossed.force("crossing")
below("lateral force of crossed edges", max(abs(force[0]), abs(force[1])) / force[2], 1e-10)
pair = "Contact pair crossing"
swapped = run("swapped", scene, {f"{pair}/Slave body": "lower",
                                 f"{pair}/Slave boundaries": "top, back",
                                 f"{pair}/Master body": "upper",
                                 f"{pair}/Master boundaries": "bottom, right"})
below("slave and master exchanged", abs(swapped.force("crossing")[2] + force[2]) / force[2], 1e-8)

for name, settings, tolerance in (("multipliers", MULTIPLIERS, 1e-7),
                                  ("augmented", AUGMENTED, 1e-6),
                                  ("penalty", PENALTY, 5e-3),
                                  ("consistent", CONSISTENT, 1e-7),
                                  ("gmres", {**GMRES, **CONSISTENT}, 1e-6)):
    same(across, run(name, tests / "edge_across_edge.prm", settings), tolerance)
same(crossed, run("cg", scene, CG), 1e-6)
same(crossed, run("averaged", scene, {f"{pair}/Pairing": "averaged"}), 1e-7)
same(crossed, run("steps", scene, {STEPS: 5}), 1e-6)
same(vertex, run("vertex_augmented", tests / "vertex_in_slave_face.prm",
                 {**AUGMENTED, **CONSISTENT}), 1e-6)

# The forces of the nodes in contact.vtu are all of the contact.
for name, file in (("across", "edge_across_edge.prm"), ("vertex", "vertex_in_slave_face.prm")):
    drawn = run(f"drawn_{name}", tests / file, vtu=None)
    (pair_name, result), = drawn.summary["results"]["contact"].items()
    found = [sum(node.force[d] for node in drawn.contact_nodes()) for d in range(3)]
    below(f"{pair_name}, forces of nodes and of the pair",
          max(abs(a - b) for a, b in zip(found, result["force"])) /
          max(map(abs, result["force"])), 1e-6)

# Newton's method converges quadratically.
quadratic = run("quadratic", scene, {**CONSISTENT, STEPS: 1})
check(quadratic.iterations() <= 7, f"{quadratic}: {quadratic.iterations()} iterations")

# Two blocks that meet in one edge are pressed on each other across it: one of them on a plane in the middle.
PLANE = """subsection Obstacle plane
  set Point     = 1, 0, 1
  set Direction = 1, 0, 1
end
"""
upper = block("upper", 1, 2, -0.1)
on_plane = run("on_plane", pressed("on_plane", "set Bodies    = upper\nset Obstacles = plane\n", upper + PLANE,
                                   "  set Obstacle         = plane\n")).force("edge")
parallel = pressed("parallel", "set Bodies = lower, upper\n", block("lower", 0, 2, 0.1) + upper, ON_EDGE)
for name, settings in (("parallel", {}), ("parallel_augmented", AUGMENTED), ("parallel_consistent", CONSISTENT)):
    result = run(name, parallel, settings)
    below(f"{result}, force against that on a plane",
          max(abs(a - b) for a, b in zip(result.force("edge"), on_plane)) / on_plane[2], 1e-8)
# The same rows belong to all pairings: averages over the faces beside the edges do not have their direction.
AVERAGED, INSIDE_OUTSIDE = ({f"Contact pair edge/Pairing": name} for name in ("averaged", "inside-outside"))
for name, settings in (("parallel_averaged", AVERAGED), ("parallel_inside_outside", INSIDE_OUTSIDE),
                       ("parallel_averaged_consistent", {**AVERAGED, **CONSISTENT})):
    result = run(name, parallel, settings)
    below(f"{result}, force against that on a plane",
          max(abs(a - b) for a, b in zip(result.force("edge"), on_plane)) / on_plane[2], 1e-8)
# Nodes along the edges that do not match, pressed until an edge is nearly flat: the force stays that of mirror images.
other = run("parallel_other", pressed("parallel_other", "set Bodies = lower, upper\n",
                                      block("lower", 0, 3, 0.1) + upper, ON_EDGE))
force = other.force("edge")
below(f"{other}, force across the plane in the middle", abs(force[0] - force[2]) / on_plane[2], 1e-8)
averaged = run("parallel_other_averaged", folder / "parallel_other.prm", AVERAGED)
below(f"{averaged}, force against pointwise rows",
      max(abs(a - b) for a, b in zip(averaged.force("edge"), force)) / on_plane[2], 1e-8)
# Free ends with friction, meshes that do not match: the force is that of mirror images in any number of steps, with
# any pairing, and next to that of the other roles. Before, it was 2.5 and 2.1, or 4.8 and 4.4, by the path of Newton's
# method. An edge that hangs over the end of the other one is held there.
FREE = {"Body lower/Symmetry": "", "Body upper/Symmetry": "", "Contact pair edge/Behaviour": "coulomb",
        "Contact pair edge/Friction/Coefficient": 0.3,
        **{f"Body {body}/Boundary {side}/Displacement y": 0
           for body, sides in (("lower", ("left", "bottom")), ("upper", ("right", "top"))) for side in sides}}
LONGER = {"Body upper/Geometry/Lower corner": "1, 0.3, 1", "Body upper/Geometry/Upper corner": "2, 1.3, 2",
          "Body lower/Geometry/Cells": "3, 2, 3", "Body upper/Geometry/Cells": "3, 5, 3"}
# Beside the end of the edge slave faces are bent round it, and what they have in common with the master is steep.
SHIFTED = {"Body upper/Geometry/Lower corner": "1, 0.8, 1", "Body upper/Geometry/Upper corner": "2, 1.8, 2"}
ROLES = {"Contact pair edge/Slave body": "lower", "Contact pair edge/Slave boundaries": "top, right",
         "Contact pair edge/Master body": "upper", "Contact pair edge/Master boundaries": "bottom, left"}
for name, scene_settings in (("free", {}), ("longer", LONGER), ("shifted", SHIFTED)):
    first = run(name, folder / "parallel_other.prm", {**FREE, **scene_settings}).force("edge")
    below(f"{name}, force across the plane in the middle", abs(first[0] - first[2]) / first[2], 1e-8)
    for other_name, settings in (("one_step", {STEPS: 1}), ("averaged", AVERAGED), ("inside_outside", INSIDE_OUTSIDE),
                                 ("averaged_one_step", {**AVERAGED, STEPS: 1}), ("multipliers", MULTIPLIERS)):
        other = run(f"{name}_{other_name}", folder / "parallel_other.prm", {**FREE, **scene_settings, **settings})
        below(f"{other}, force against that of {name}",
              max(abs(a - b) for a, b in zip(other.force("edge"), first)) / first[2], 1e-6)
    other = run(f"{name}_roles", folder / "parallel_other.prm", {**FREE, **scene_settings, **ROLES})
    below(f"{other}, force against that of {name}",
          max(abs(a + b) for a, b in zip(other.force("edge"), first)) / first[2], 0.12)
    two = run(f"{name}_two_ranks", folder / "parallel_other.prm", {**FREE, **scene_settings}, ranks=2)
    below(f"{two}, force against one rank",
          max(abs(a - b) for a, b in zip(two.force("edge"), first)) / first[2], 1e-8)
# Where the pair names one side of an edge only, the blocks slide off each other and one enters the other by more
# than a third of a cell, beside nodes that carry a force: the run says so, with the remedy.
one_side = pressed("one_side", "set Bodies = lower, upper\n", block("lower", 0, 2, 0.1) + upper,
                   ON_EDGE.replace("top, right", "top"))
other_side = pressed("other_side", "set Bodies = lower, upper\n", block("lower", 0, 2, 0.1) + upper, ON_EDGE, "bottom")
for name, path, side in (("one_side", one_side, "Master"), ("other_side", other_side, "Slave")):
    words = " ".join(run(name, path).summary["warnings"])
    check("contact pair 'edge': an edge of body 'lower' reaches into body 'upper'" in words and
          f"name the faces on both sides of them in '{side} boundaries'" in words, f"{name}: {words}")
# Friction: bodies that slide along each other's edge pull with mu N, one that sticks holds.
slides = {f"{pair}/Behaviour": "coulomb", f"{pair}/Friction/Coefficient": 0.2,
          "Body upper/Boundary top/Displacement y": "max(0, 0.2 * (t - 0.5))",
          "Body upper/Boundary left/Displacement y": "max(0, 0.2 * (t - 0.5))",
          STEPS: 8}
sliding = run("sliding", scene, slides)
normal, tangential = sliding.force("crossing")[2], sliding.force("crossing")[1]
# But for the tilt of the edges, which the pull bends a little.
below("coefficient of friction", relative(-tangential / normal, 0.2), 0.08)
other = run("sliding_augmented", scene, {**slides, **AUGMENTED})
below("friction with augmented Lagrange", max(relative(x, y) for x, y in zip(
    sliding.force("crossing")[1:], other.force("crossing")[1:])), 1e-5)
finish()
