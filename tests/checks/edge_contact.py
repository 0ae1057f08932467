# SPDX-License-Identifier: LGPL-2.1-or-later
"""Edges that cross and a vertex in a face: one answer of all enforcements, solvers, pairings and
roles, symmetry, and what cannot be solved says so."""
# ctest: goldens = crossed_edges, edge_across_edge, vertex_in_slave_face

from touchstone_test import (AUGMENTED, CG, GMRES, MULTIPLIERS, PENALTY, STEPS, below, check, finish,
                             golden, relative, run, same, tests)

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
