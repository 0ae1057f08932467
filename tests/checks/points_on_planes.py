# SPDX-License-Identifier: LGPL-2.1-or-later
"""Points inside slave faces beside planes of symmetry: a place on such a plane lies in the body whatever
the last digit of its position says. A quarter of a cap that rises from its dent in a quarter of a box,
both plastic, and its mirror image had vertical forces of 0.146 and 0.099 (exit code 0, with a warning),
as places on the planes, 1e-20 outside of the cells, counted in one of them and not in the other."""
# ctest: label = quick

from touchstone_test import MULTIPLIERS, below, check, checks, finish, relative, run

MIRRORED = {"Body low/Symmetry": "left, front, top", "Body low/Geometry/Lower corner": "0, 0, 0",
            "Body low/Geometry/Upper corner": "0.00114309182351222, 0.00114309182351222, 0.0008",
            "Body low/Geometry/Grading": "1.648, 1, 0.420344682639765",
            "Body top/Geometry/Contact side": "top",
            "Body top/Boundary far/Displacement z": "4.57025555683184e-05 * (min(1, t) - 1.5 * max(0, t - 1))",
            "Contact pair contact/Slave boundaries": "bottom"}
scene = checks / "cap_on_planes.prm"
one = run("one", scene)
other = run("mirrored", scene, MIRRORED)
two = run("two_ranks", scene, ranks=2)
multipliers = run("multipliers", scene, MULTIPLIERS)
times, forces = one.column("time"), one.column("contact: force z")
at = times.index(1.5)
check(abs(forces[at]) > 0.1, f"the cap is carried by a point as it rises: {forces[at]}")
for result, sign in ((other, -1), (two, 1), (multipliers, 1)):
    for k in range(1, at + 1):
        below(f"{result}, force at {times[k]}",
              relative(sign * result.column("contact: force z")[k], forces[k]), 1e-6)
finish()
