# SPDX-License-Identifier: LGPL-2.1-or-later
"""General contact at planes of symmetry: a body that folds through its own plane passes through its mirror image,
which the run must say; and `crossings`, which looks at the whole body (doc/general_contact.md, section 6.1)."""

from touchstone_test import check, finish, run
from self_contact_scenes import TOP, write  # of tests/, which touchstone_test finds
import crossings

ITSELF, PASSED = "  set Slave boundaries = all\n", "passed through its plane of symmetry"
CUTS = "first cut, start, end"
# The plane of symmetry and the two sides, which are none of the surface either.
PLANES = (2, 0), (1, 0), (1, 1)


def warning(result):
    """The warning of a run, if there is one."""
    return {line[line.index("at time"):] for line in result.log.splitlines() if PASSED in line}


def last(result):
    """The result at the end."""
    return max(result.folder.glob("solution_*.vtu"))


# Half of a C whose end is pressed down to where the other half comes up.
through = write("through", 270, 150, "2, 20, 1", 6.2, 4, 20, CUTS, (TOP,), ITSELF)
one, two = run("through", through, vtu=50), run("through_2", through, ranks=2)
one.says(PASSED)
one.says("Shape = plane")
check(bool(warning(one)) and warning(one) == warning(two), f"ranks differ: {warning(one)}, {warning(two)}")
check(len(crossings.find(last(one), mirrored=PLANES)) > 0, "the tool does not see the mirror image")
try:
    crossings.find(last(one))
    check(False, "the tool takes cuts for surfaces")
except ValueError:
    pass
# An obstacle in the plane, as the warning says.
stopped = run("stopped", write("stopped", 270, 150, "2, 20, 1", 6.2, 4, 20, CUTS, (
    TOP, ("middle", 0, 1, 0, "inner, outer, second cut")), ITSELF), vtu=50)
check(not warning(stopped), f"stopped: {warning(stopped)}")
places = crossings.find(last(stopped), mirrored=PLANES)
check(not places, f"stopped: {len(places)} crossings with the mirror image, the first at {places[:1]}")
# What is on both sides of a plane from the start is on rollers there, and no mirror image is meant.
rollers = run("rollers", write("rollers", 270, 200, "2, 26, 1", 1, 4, 20, CUTS, (TOP,), ITSELF))
check(not warning(rollers), f"rollers: {warning(rollers)}")
finish()
