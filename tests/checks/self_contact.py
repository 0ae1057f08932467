# SPDX-License-Identifier: LGPL-2.1-or-later
"""Self-contact of implicit runs against half of the body and a plane in the middle: a ring that is pressed
between two planes until its inner walls meet and are pressed on (doc/theory.md, section 4.4), and a C that
closes until its ends meet, sharp edge on sharp edge, and is pressed on (section 4.2, "Parallel edges")."""

import shutil

from touchstone_test import (AUGMENTED, CG, MULTIPLIERS, PENALTY, below, check, checkpoints, fail, finish, folder,
                             lose_last_checkpoint, resume, run, same)
from self_contact_scenes import BOTTOM, TOP, write  # of tests/, which touchstone_test finds

# Of facets: the walls are bent flat where they meet, but the arches of the circle that they were stay (theory, 4.6).
ITSELF = ("  set Slave boundaries = all\n  set Master body = ring\n  set Master boundaries = all\n"
          "  set Pairing = pointwise\n  set Contact geometry = faceted\n")
COULOMB = "  set Behaviour = coulomb\n  subsection Friction\n    set Coefficient = 0.3\n  end\n"
STATIC, DYNAMIC = ("  set Scheme = static\n", "  set Scheme = generalized_alpha\n")
CUTS, PAIR = "first cut, second cut, start, end", "Contact pair itself"


def scenes(name, scheme, steps, damping=0):
    """The whole ring and its half."""
    common = {"element": "F-bar", "scheme": scheme, "steps": steps}
    return (write(name, 0, 180, "3, 24, 1", 8.2, 1, damping, CUTS, (TOP, BOTTOM), ITSELF, **common),
            write(f"{name}_half", 0, 90, "3, 12, 1", 8.2, 1, damping, CUTS, (TOP, ("middle", 0, 1, 0, "inner")), "",
                  **common))


def history(result, column="top: force z"):
    """The force of the upper plane, or another column, by time; steps may have been cut."""
    return {round(row["time"], 9): row[column] for row in result.rows()}


def compare(one, other, bound, nodes=20):
    """The forces of the whole body against those of the half, at all times that both have; at the end so
    many @p nodes of the whole touch it."""
    forces, expected = history(one), history(other)
    times = set(forces) & set(expected)
    check(len(times) >= 20, f"{one}: only {len(times)} times to compare")
    below(f"{one}, force against that of {other}", max((abs(forces[t] - expected[t]) for t in times), default=1) /
          max(map(abs, expected.values())), bound)
    check(one.column("itself: active nodes")[-1] >= nodes, f"{one}: the ring does not touch itself")
    below(f"{one}, penetration", max(one.column("itself: max penetration")), 1e-6)


whole, half = scenes("static", STATIC, 20)
reference, expected = run("whole", whole), run("half", half)
compare(reference, expected, 2e-4)
# Only symmetric parts of the walls move against each other, so that friction makes no difference but where
# normals of facets are oblique.
text = whole.read_text(encoding="utf-8")
friction = folder / "friction.prm"
friction.write_text(text.replace(ITSELF, ITSELF.replace("faceted", "manifold") + COULOMB), encoding="utf-8")
rubbing = run("friction", friction)
compare(rubbing, expected, 1e-3)
same(rubbing, run("friction_cg", friction, CG), 1e-6)

same(reference, run("multipliers", whole, MULTIPLIERS), 1e-7)
same(reference, run("augmented", whole, AUGMENTED), 1e-6)
same(reference, run("cg", whole, CG), 1e-6)
same(reference, run("consistent", whole, {"Contact/Linearisation": "consistent"}), 1e-7)
two = run("whole_2", whole, ranks=2)
same(reference, two, 1e-8)
compare(run("two_sides", whole, {f"{PAIR}/Slave boundaries": "inner", f"{PAIR}/Master boundaries": "inner, outer"}),
        expected, 1e-3)
# A penalty leaves an overlap, and each side of the half has all of it.
below("penalty", abs(run("penalty", whole, PENALTY).force("top")[2] / expected.force("top")[2] - 1), 0.03)

whole, half = scenes("dynamic", DYNAMIC, 40, 20)
reference, expected = run("dynamic", whole), run("dynamic_half", half)
compare(reference, expected, 1e-3)
same(reference, run("dynamic_2", whole, ranks=2), 1e-8)

# A C whose ends meet with the edges of their inner walls, which the planes press on each other. In statics
# soft springs hold it along the planes.
SPRINGS = """subsection Body ring
  set Boundary conditions = inner
  subsection Boundary inner
    set Spring stiffness normal     = 1e-3
    set Spring stiffness tangential = 1e-3
  end
end
"""
for name, more in (("c_static", {"scheme": STATIC, "steps": 20, "more": SPRINGS}),
                   ("c_dynamic", {"scheme": DYNAMIC, "steps": 25})):
    damping = 20 if name == "c_dynamic" else 0
    c = write(name, 120, 300, "2, 40, 1", 6.2, 4, damping, "start, end", (TOP, BOTTOM), ITSELF,
              element="F-bar", **more)
    half_c = write(f"{name}_half", 270, 150, "2, 20, 1", 6.2, 4, damping, "first cut, start, end",
                   (TOP, ("middle", 0, 1, 0, "inner, outer, second cut")), "", element="F-bar", **more)
    reference, expected = run(name, c), run(f"{name}_half", half_c)
    compare(reference, expected, 1e-6, nodes=2)
    edges, on_plane = history(reference, "itself: force z"), history(expected, "middle: force z")
    below(f"{name}, force of the edges against that of the half on the plane",
          max(abs(edges[t] - on_plane[t]) for t in set(edges) & set(on_plane)) / max(on_plane.values()), 1e-6)
    same(reference, run(f"{name}_2", c, ranks=2), 1e-8)

refused = run("adaptive", whole, {"Refinement/Estimator": "Kelly"}, fails=True)
check("touches itself" in refused.text, f"{refused}: {refused.text}")

# Resumed while the walls are pressed on each other: the same to the last digit.
kept = run("kept", whole, {"Checkpoints/Steps between": 39})
shutil.copytree("kept", "resumed", dirs_exist_ok=True)
n_checkpoints = len(checkpoints("resumed"))
check(n_checkpoints == 2, f"resumed: {n_checkpoints} checkpoints instead of 2")
lose_last_checkpoint("resumed")
resume("walls", "resumed", whole, {"Checkpoints/Steps between": 39})
if (folder / "resumed/statistics").read_text() != (folder / "kept/statistics").read_text():
    fail("resumed: other figures than without a restart")

# What pairs cannot see must not end with exit code 0: the inner walls pass through each other.
blind = run("blind", folder / "static.prm",
            {f"{PAIR}/Slave boundaries": "outer", f"{PAIR}/Master boundaries": "outer"}, fails=True)
check("reaches into itself" in blind.text, f"{blind}: nothing is said of the overlap")
finish()
