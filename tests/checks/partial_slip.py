# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cattaneo and Mindlin, loading and unloading, against the exact tractions on three meshes. That
enforcements and pairings agree is shown on the coarse one."""

from touchstone_test import (AUGMENTED, MULTIPLIERS, PENALTY, STEPS, below, check, finish, prm, resume,
                             run, same)

ERRORS = "contact_half_width", "stick_half_width", "pressure_l2", "shear_traction_l2"
VALUES = ("radius: 50, young modulus: 210000, poisson ratio: 0.3, friction coefficient: 0.3, "
          "depth: 0.25")
# Width of the fine part of the surface, which puts the edge of the contact at the same place in
# a cell of each mesh.
WIDTHS = {6: 1.24, 12: 1.2, 24: 1.183}


def slip(name, cells, half_widths, pressure, shear, settings=None, ranks=1, goes_on=None):
    """CELLS over the fine part of the surface; then bounds of errors. GOES_ON: from the end of that run."""
    mesh = {f"Body {body}/Geometry/Contact {what}": value for body in ("upper", "lower")
            for what, value in (("cells", cells), ("layers", cells), ("width", WIDTHS[cells]))}
    scene, settings = prm / "benchmarks/cattaneo_mindlin.prm", {**mesh, **(settings or {})}
    result = resume(name, goes_on.folder, scene, settings) if goes_on else run(name, scene, settings, ranks)
    for error, bound in zip(ERRORS, (half_widths, half_widths, pressure, shear)):
        below(f"{name}, {error}", result.error(error), bound)
    return result


coarse = slip("coarse", 6, 0.04, 0.01, 0.08)
medium = slip("medium", 12, 0.025, 0.006, 0.02, {"Checkpoints/Steps between": 8})
same(coarse, slip("ranks", 6, 0.04, 0.01, 0.08, ranks=2), 1e-6)
for name, settings in (("multipliers", MULTIPLIERS), ("augmented", AUGMENTED)):
    same(coarse, slip(name, 6, 0.04, 0.01, 0.08, settings), 1e-6)
slip("averaged", 6, 0.04, 0.01, 0.08, {"Contact pair contact/Pairing": "averaged"})
slip("penalty", 6, 0.04, 0.01, 0.08, PENALTY)
fine = slip("fine", 24, 0.006, 0.005, 0.012)
for name in ERRORS:
    if name != "contact_half_width":  # has hardly any error from the second mesh on
        below(f"fine, {name}, to fall with the mesh", fine.error(name), medium.error(name))
    below(f"medium, {name}, to fall with the mesh", medium.error(name), coarse.error(name))


def back(name, before, end, half_widths, shear):
    """On from BEFORE, down from the peak: half the distance to the other side at time 14, all of it at 16."""
    return slip(name, 12, half_widths, 0.006, shear,
                {"Load stepping/End time": end, STEPS: end, "Checkpoints/Steps between": 2,
                 "Reference solution/Values":
                 f"{VALUES}, peak tangential force: {-medium.force('contact')[0]}"}, goes_on=before)


other_side = back("other_side", back("reversed", medium, 14, 0.03, 0.05), 16, 0.025, 0.02)

# Masing: going back, the force changes by twice what it took to go half as far at first,
# Q* - Q(t) = 2 Q(4 + (t - 8) / 2).
force = {round(row["time"]): row["contact: force x"] for row in other_side.rows()}
for t in range(10, 17, 2):
    off = abs((force[8] - force[t]) / force[8] - 2 * force[4 + (t - 8) // 2] / force[8])
    below(f"hysteresis at t = {t}, off by, of the peak", off, 1e-4)
check(len(force) == 16, "not all steps are in the statistics")
finish()
