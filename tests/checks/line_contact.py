# SPDX-License-Identifier: LGPL-2.1-or-later
"""Line contact has one solution: half a tube on a plane that touches along a line of its mesh, between
two lines and beside one, as slave and as master: elimination, multipliers, augmented Lagrange and
GMRES agree, and averaged rows agree with pointwise ones as far as the mesh allows."""
# ctest: goldens = line_contact

from touchstone_test import (AUGMENTED, GAP, GMRES, MULTIPLIERS, below, finish, golden, relative, run,
                             same, tests)

scene = tests / "line_contact.prm"
POINTWISE = {"Contact pair contact/Pairing": "pointwise"}
SWAPPED = {"Contact pair contact/Slave body": "base", "Contact pair contact/Slave boundaries": "top",
           "Contact pair contact/Master body": "tube",
           "Contact pair contact/Master boundaries": "outer"}
CASES = {"between": {"Body tube/Geometry/Cells": "2, 7, 2"},
         "beside": {"Body tube/Geometry/First angle": 185},
         "swapped": SWAPPED}


def methods(name, one, settings):
    """All exact methods, and the pointwise rows for the size of it."""
    for label, method in (("multipliers", MULTIPLIERS), ("gmres", GMRES),
                          ("augmented", {**AUGMENTED, GAP: 1e-10})):
        same(one, run(f"{name}-{label}", scene, {**settings, **method}), 1e-6)
    pointwise = run(f"{name}-pointwise", scene, {**settings, **POINTWISE})
    below(f"{name}, force beside that of pointwise rows",
          relative(one.force("contact")[2], pointwise.force("contact")[2]), 0.1)


methods("line", golden("line_contact"), {})
for name, settings in CASES.items():
    methods(name, run(name, scene, settings), settings)
finish()
