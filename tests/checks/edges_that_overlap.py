# SPDX-License-Identifier: LGPL-2.1-or-later
"""Edges and vertices that lie within the other body at the start of a run: what is pushed on from
there comes to the state of the same motion without overlap, whether the overlap counts at once or
grows with time. Before, all of this ended with exit code 2, but for parallel edges, whose forces
were by half too small with exit code 0."""
# ctest: goldens = edge_across_edge, vertex_in_slave_face

from touchstone_test import AUGMENTED, GMRES, MULTIPLIERS, STEPS, below, finish, golden, run, same, tests
from edge_on_edge_scenes import ON_EDGE, block, pressed  # of tests/, which touchstone_test finds

LOWER, UPPER = "Body {}/Geometry/Lower corner", "Body {}/Geometry/Upper corner"
RAMP, PAIRING = "Contact pair {}/Initial overlap", "Contact pair edge/Pairing"


def moved(body, sides, lower, upper, by, drive):
    """A body that is placed deeper by a part of its motion, and driven by the rest."""
    place = {LOWER.format(body): ", ".join(str(c) for c in (*lower[:2], lower[2] - by)),
             UPPER.format(body): ", ".join(str(c) for c in (*upper[:2], upper[2] - by))}
    return {**place, **{f"Body {body}/Boundary {side}/Displacement z": f"-{drive - by} * t" for side in sides}}


across, vertex = golden("edge_across_edge"), golden("vertex_in_slave_face")
for depth in (0.01, 0.05, 0.15):
    settings = {STEPS: 1, **moved("upper", ("top", "left"), (0, -0.4, 2.1313203435596426), (1, 0.6, 3.131320343559642),
                                  depth, 0.15)}
    same(across, run(f"across_{depth}", tests / "edge_across_edge.prm", settings), 1e-7)
for name, more, tolerance in (("ramp", {RAMP.format("c"): "ramp", STEPS: 3}, 1e-7),
                              ("multipliers", MULTIPLIERS, 1e-7), ("augmented", AUGMENTED, 1e-6), ("gmres", GMRES, 1e-6)):
    same(across, run(f"across_{name}", tests / "edge_across_edge.prm", {**settings, **more}), tolerance)
same(across, run("across_2", tests / "edge_across_edge.prm", settings, 2), 1e-7)
settings = {STEPS: 1, **moved("cube", ("top",), (0, 0, 0.005), (1, 1, 1.005), 0.05, 0.1)}
same(vertex, run("vertex", tests / "vertex_in_slave_face.prm", settings), 1e-7)
same(vertex, run("vertex_ramp", tests / "vertex_in_slave_face.prm", {**settings, RAMP.format("c"): "ramp", STEPS: 3}),
     1e-7)

# Two blocks edge on edge.
def blocks(overlap):
    """Write the scene of blocks that overlap by a part of what presses them together."""
    return pressed(f"overlap_{overlap}", "set Bodies = lower, upper\n",
                   block("lower", 0, 2, 0.1) + block("upper", 1 - overlap, 2, overlap - 0.1), ON_EDGE)


without = run("without", blocks(0)).force("edge")
for overlap in (0.01, 0.06, 0.1):
    scene = blocks(overlap)
    for name, settings in (("averaged", {PAIRING: "averaged"}), ("pointwise", {}),
                           ("inside_outside", {PAIRING: "inside-outside"}),
                           ("ramp", {PAIRING: "averaged", RAMP.format("edge"): "ramp", STEPS: 3})):
        result = run(f"{scene.stem}_{name}", scene, {STEPS: 1, **settings})
        below(f"{result}, force against that of blocks without overlap",
              max(abs(a - b) for a, b in zip(result.force("edge"), without)) / without[2], 1e-8)
    two = run(f"{scene.stem}_two_ranks", scene, {STEPS: 1, PAIRING: "averaged"}, ranks=2)
    below(f"{two}, force against one rank",
          max(abs(a - b) for a, b in zip(two.force("edge"), without)) / without[2], 1e-8)
finish()
