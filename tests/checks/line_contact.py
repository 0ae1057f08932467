# SPDX-License-Identifier: LGPL-2.1-or-later
"""Line contact has one solution: half a tube on a plane that touches along a line of its mesh, between
two lines and beside one: elimination, multipliers, augmented Lagrange and GMRES agree, and along the
line averaged rows with pointwise ones as far as the mesh allows."""
# ctest: goldens = line_contact

from touchstone_test import (AUGMENTED, GAP, GMRES, MULTIPLIERS, below, finish, golden, relative, run,
                             tests)

scene = tests / "line_contact.prm"
POINTWISE = {"Contact pair contact/Pairing": "pointwise"}
CASES = {"between": {"Body tube/Geometry/Cells": "2, 7, 2"},
         "beside": {"Body tube/Geometry/First angle": 182}}
# The default tolerance of gaps makes 1e-5 of the force.
CLOSED = {GAP: 1e-11}


def methods(name, settings):
    """All exact methods have the same force."""
    settings = {**CLOSED, **settings}
    force = run(name, scene, settings).force("contact")[2]
    for label, method in (("multipliers", MULTIPLIERS), ("gmres", GMRES), ("augmented", AUGMENTED)):
        below(f"{name}, {label}",
              relative(run(f"{name}-{label}", scene, {**settings, **method}).force("contact")[2],
                       force), 1e-6)


below("line, force beside that of pointwise rows",
      relative(golden("line_contact").force("contact")[2],
               run("pointwise", scene, POINTWISE).force("contact")[2]), 0.02)
methods("line", {})
for name, settings in CASES.items():
    methods(name, settings)
finish()
