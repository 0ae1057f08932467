# SPDX-License-Identifier: LGPL-2.1-or-later
"""A block that goes through a thin plate in one increment ends on the side from which it came: the
same state as in many small steps, with both pairings, on one and two ranks."""

from touchstone_test import STEPS, below, check, checks, finish, run, same

for pairing in "averaged", "pointwise":
    settings = {"Contact pair contact/Pairing": pairing}
    plate = run(pairing, checks / "thin_plate.prm", settings)
    # A plate in bending: forces are small differences.
    same(plate, run(f"{pairing}_2", checks / "thin_plate.prm", settings, 2), 1e-7)
    same(plate, run(f"{pairing}_small_steps", checks / "thin_plate.prm", {**settings, STEPS: 8}), 1e-6)
    below(f"{plate}, penetration", plate.contact("contact", "max_penetration"), 1e-7)
    check(plate.contact("contact", "active") > 3, f"{plate}: hardly any contact")
finish()
