# SPDX-License-Identifier: LGPL-2.1-or-later
"""Self-contact of explicit dynamics against half of the body and a plane in the middle: a ring that is
pressed between two planes until its inner walls meet, and a C whose ends meet (doc/general_contact.md,
section 7)."""

from touchstone_test import below, check, contact_gives, finish, run
from self_contact_scenes import BOTTOM, TOP, write  # of tests/, which touchstone_test finds


def compare(name, whole, half, alone):
    """Forces of the upper plane of the whole body and its half; @p alone: without self-contact."""
    one, other = run(f"{name}_whole", whole), run(f"{name}_half", half)
    forces, expected = (result.column("top: force z") for result in (one, other))
    largest = max(map(abs, expected))
    below(f"{name}, force against that of the half", max(abs(a - b) for a, b in zip(forces, expected)) / largest,
          1e-3)
    # The planes do not touch each other's half: without contact in the middle nothing would stop it.
    check(max(other.column("middle: force z")) > 0.1 * largest, f"{name}: the middle does not touch")
    contact_gives(one, 1e-6)
    both = run(f"{name}_whole_2", whole, ranks=2)
    check(one.summary.get("motion") == both.summary.get("motion"), f"{name}: one and two ranks differ")
    free = run(f"{name}_alone", alone)
    check(max(abs(a - b) for a, b in zip(free.column("top: force z"), expected)) > 0.01 * largest,
          f"{name}: without self-contact the force is the same")


# A pair of nothing but a slave body is general contact.
GENERAL = "  set Slave boundaries = all\n"
RING = "3, 24, 1", 8.2, 1, 0, "first cut, second cut, start, end", (TOP, BOTTOM)
compare("ring", write("ring", 0, 180, *RING, GENERAL),
        write("half_ring", 0, 90, "3, 12, 1", 8.2, 1, 0, "first cut, second cut, start, end",
              (TOP, ("middle", 0, 1, 0, "inner")), ""), write("ring_alone", 0, 180, *RING, ""))
# Damped, as the ends would bounce off each other.
BENT = "2, 40, 1", 6.2, 4, 20, "start, end", (TOP, BOTTOM)
compare("c", write("c", 120, 300, *BENT, GENERAL),
        write("half_c", 270, 150, "2, 20, 1", 6.2, 4, 20, "first cut, start, end",
              (TOP, ("middle", 0, 1, 0, "inner, outer, second cut")), ""), write("c_alone", 120, 300, *BENT, ""))
finish()
