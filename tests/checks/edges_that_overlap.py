# SPDX-License-Identifier: LGPL-2.1-or-later
"""Edges and vertices that lie within the other body at the start of a run: what is pushed on from
there comes to the state of the same motion without overlap, whether the overlap counts at once or
grows with time. Before, all of this ended with exit code 2, but for parallel edges, whose forces
were by half too small with exit code 0."""
# ctest: goldens = edge_across_edge, vertex_in_slave_face

from touchstone_test import (AUGMENTED, GMRES, MULTIPLIERS, STEPS, below, finish, folder, golden, relative, run,
                             same, tests)
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


# A press fit of 8 and 12 facets, whose vertices at the end of the inner tube lie in faces and on edges of the
# slave. Vertices that share a face are not taken for each other: the scene turned has the force turned, and
# none across. Before, one of four vertices that lie on edges kept a row, or none did, as it was turned.
FIT = """set Bodies        = outer, inner
set Contact pairs = fit
subsection Body outer
  set Fixed = outer
  subsection Geometry
    set Type         = tube
    set Axis         = {axis}
    set Angle        = 360
    set End          = 0.82429
    set Inner radius = 1
    set Inner slope  = 0.0247
    set Outer radius = 1.32939
    set Cells        = 2, 12, 2
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0
  end
end
subsection Body inner
  set Fixed = inner
  subsection Geometry
    set Type         = tube
    set Axis         = {axis}
    set Angle        = 360
    set Start        = 0.24729
    set End          = 1.07158
    set Inner radius = 0.4044
    set Outer radius = 0.99745
    set Outer slope  = 0.0247
    set Cells        = 2, 8, 2
  end
  subsection Material
    set Young modulus = 109.274
    set Poisson ratio = 0.308
  end
end
subsection Contact pair fit
  set Slave body        = outer
  set Slave boundaries  = inner
  set Master body       = inner
  set Master boundaries = outer
  set Pairing           = pointwise
  set Contact geometry  = faceted
  set Behaviour         = tresca
  subsection Friction
    set Shear strength = 2.849
  end
end
"""


def fit(axis, ranks=1):
    """Its force along the axis; what it has across must vanish."""
    scene = folder / f"fit_{axis}.prm"
    scene.write_text(FIT.format(axis=axis), encoding="utf-8")
    result = run(f"fit_{axis}_{ranks}", scene, ranks=ranks)
    force = result.force("fit")
    along = force.pop("xyz".index(axis))
    below(f"{result}, force across", max(map(abs, force)) / abs(along), 1e-8)
    return along


along_x = fit("x")
for axis, ranks in (("y", 1), ("z", 1), ("y", 2)):
    below(f"fit along {axis}, {ranks} ranks", relative(fit(axis, ranks), along_x), 1e-8)
finish()
