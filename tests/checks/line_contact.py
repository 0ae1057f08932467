# SPDX-License-Identifier: LGPL-2.1-or-later
"""Line contact has one solution: half a tube on a plane, on a tube and in one that is hardly wider, along a
line of its mesh, between two lines and beside one: elimination, multipliers, augmented Lagrange, conjugate
gradients, GMRES and two ranks agree, and along a line of the mesh averaged rows with pointwise ones, however small curvature
and load. Surfaces that fit each other take as many iterations as ever."""
# ctest: goldens = line_contact

import math
import pathlib

from touchstone_test import (AUGMENTED, CG, GAP, GMRES, MULTIPLIERS, STEPS, below, finish, golden, prm,
                             relative, run, tests)

scene = tests / "line_contact.prm"
POINTWISE = {"Contact pair contact/Pairing": "pointwise"}
TUBE = {"Type": "tube", "Axis": "x", "Origin": "0, 0, -0.6", "Start": -0.5, "End": 0.5,
        "Inner radius": 0.3, "Outer radius": 0.6, "Angle": 180, "Cells": "2, 8, 3"}
CASES = {"between": {"Body tube/Geometry/Cells": "2, 7, 2"},
         "beside": {"Body tube/Geometry/First angle": 182}}
# The default tolerance of gaps makes 1e-5 of the force.
CLOSED = {GAP: 1e-11}


def force(name, settings, ranks=1, where=scene):
    return run(name, where, settings, ranks).force("contact")[2]


def methods(name, settings, where=scene):
    """All exact methods have the same force."""
    settings = {**CLOSED, **settings}
    answer = force(name, settings, where=where)
    for label, method, ranks in (("multipliers", MULTIPLIERS, 1), ("gmres", GMRES, 1), ("cg", CG, 1),
                                 ("augmented", AUGMENTED, 1), ("one_step", {STEPS: 1, **GMRES}, 1),
                                 ("ranks", GMRES, 2)):
        bound = 1e-5 if label == "one_step" else 1e-6
        below(f"{name}, {label}",
              relative(force(f"{name}-{label}", {**settings, **method}, ranks, where), answer), bound)
    return answer


def write(name, replaced):
    """A scene like line_contact with other text."""
    text = scene.read_text(encoding="utf-8")
    for before, after in replaced.items():
        assert before in text, before
        text = text.replace(before, after)
    (path := pathlib.Path(f"{name}.prm")).write_text(text, encoding="utf-8")
    return path.resolve()


below("line, force beside that of pointwise rows",
      relative(golden("line_contact").force("contact")[2], force("pointwise", POINTWISE)), 0.02)
methods("line", {})
for case, changes in CASES.items():
    methods(case, changes)

# Two tubes side by side.
box = scene.read_text(encoding="utf-8").split("Type         = box\n", 1)[1].split("  end\n", 1)[0]
tubes = write("tubes", {
    f"    set Type         = box\n{box}": "".join(f"    set {key} = {value}\n"
                                               for key, value in TUBE.items()),
    "Fixed = bottom": "Fixed = first cut, second cut", "boundaries = top": "boundaries = outer"})
below("tubes, force beside that of pointwise rows",
      relative(methods("tubes", {}, tubes), force("tubes-pointwise", POINTWISE, where=tubes)), 0.03)

# Half a tube in one that is 2.2 % wider, under a load that is lighter than 2 % of the height of an arch.
BORE = {**TUBE, "Origin": "0, 0, 0.4599", "Start": -0.31, "End": 0.31, "Inner radius": 0.4599,
        "Outer radius": 0.7599, "First angle": 210, "Angle": 120, "Cells": "3, 7, 2"}
bore = write("bore", {
    f"    set Type         = box\n{box}": "".join(f"    set {key} = {value}\n"
                                               for key, value in BORE.items()),
    "Fixed = bottom": "Fixed = outer", "boundaries = top": "boundaries = inner"})
LIGHT = {"Load stepping/End time": 0.02}
below("bore, force beside that of pointwise rows",
      relative(methods("bore", LIGHT, bore),
               force("bore-pointwise", {**POINTWISE, **LIGHT}, where=bore)), 0.05)

# An arc of 4 degrees and of 0.4 whose faces of 0.1 have arches of 1e-3 and 1e-4 of it; a load that
# presses by 0.02 of their height. Until now a mean gap below all gaps made nine times the force.
for degrees in 4, 0.4:
    radius = 0.8 / math.radians(degrees)
    cut = scene.read_text(encoding="utf-8")
    second = "  subsection Boundary second cut" + cut.split("  subsection Boundary second cut", 1)[1]
    second = second.split("  end\n", 1)[0] + "  end\n"
    arc = write(f"arc_{degrees}", {
        second: "", "Boundary first cut": "Boundary inner",
        "Boundary conditions = first cut, second cut": "Boundary conditions = inner",
        "Origin       = 0, 0, 0.45": f"Origin = 0, 0, {radius}",
        "Inner radius = 0.225": f"Inner radius = {radius - 0.225}",
        "Outer radius = 0.45": f"Outer radius = {radius}",
        "First angle  = 180": f"First angle = {270 - degrees / 2}",
        "Angle        = 180": f"Angle = {degrees}", "-0.01 * t": f"-{1e-4 / radius} * t"})
    below(f"arc of {degrees} degrees, force beside that of pointwise rows",
          relative(force(f"arc_{degrees}_averaged", GMRES, where=arc),
                   force(f"arc_{degrees}_pointwise", POINTWISE, where=arc)), 0.02)

# Rows of surfaces that fit do not depend on their neighbours.
insertion = run("insertion", prm / "two_tubes.prm", {STEPS: 1})
below("insertion in one step, Newton iterations", insertion.iterations(), 6)
finish()
