# SPDX-License-Identifier: LGPL-2.1-or-later
# ctest: goldens = quadratic_mesh
"""Hexahedra of 20 nodes: the radial displacement of a ring converges to that of Lame with degree 2 and
by refinement with degree 1, on two ranks and in another place; straight edges are warned of."""

import math

from touchstone_test import STEPS, below, check, finish, golden, prm, relative, run, tests

EXACT = 1.3 / 3000 * 4.4
PROBE = {"Probes": "bore", "Probe bore/Body": "ring",
         "Probe bore/Point": "0.7071067811865476,0.7071067811865476,0.5"}
DEGREE, FACTOR = "Discretisation/Degree", "Discretisation/Refinement factor"


def radial(result):
    """Length of the displacement of the probe at the end."""
    values = result.probe("bore")[-1]
    return math.hypot(*(values[f"displacement_{d}"] for d in "xyz"))


one = run("one", tests / "quadratic_mesh.prm", PROBE)
two = run("two", tests / "quadratic_mesh.prm", PROBE, ranks=2)
below("degree 2, bore moves", relative(radial(one), EXACT), 2e-3)
below("on two ranks", relative(radial(two), radial(one)), 1e-10)
below("with a probe", relative(golden("quadratic_mesh").reaction("ring", "FIRST")[1], -1), 1e-6)
check("straight edges" not in one.log, "a warning without reason")

GEOMETRY = "Body ring/Geometry/"
moved = run("moved", tests / "quadratic_mesh.prm",
            {GEOMETRY + "Rotate axis": "1,2,3", GEOMETRY + "Rotate angle": "40", GEOMETRY + "Move": "1,0,2",
             GEOMETRY + "Scale": "2", GEOMETRY + "Mirror": "x", STEPS: 1})
below("energy of a ring in another place and of twice the size",
      relative(moved.rows()[-1]["energy: strain"], 8 * one.rows()[-1]["energy: strain"]), 1e-9)

straight = run("straight", tests / "quadratic_mesh.prm", {DEGREE: 1, FACTOR: 1})
straight.says("lie up to 0.152241 beside straight cells")
check(len(straight.summary["warnings"]) == 1, "straight edges are no warning of the summary")
refined = run("refined", tests / "quadratic_mesh.prm", {**PROBE, DEGREE: 1, FACTOR: 8})
FACETS = {"Body inner tube/Geometry/Exact surfaces": "", "Body outer tube/Geometry/Exact surfaces": ""}
flat = run("flat", prm / "imported_mesh.prm", FACETS)
flat.says("has flat faces that bend by 7.5 degrees")
check(len(flat.summary["warnings"]) == 2, "not one warning for each of two curved boundaries")
smooth = run("smooth", prm / "imported_mesh.prm", {**FACETS, "Contact pair fit/Master normal": "smoothed"})
check(not smooth.summary["warnings"], "a warning of faces that smooth patches replace")
below("degree 1 on new nodes of the curves, bore moves", relative(radial(refined), EXACT), 1e-2)
finish()
