# SPDX-License-Identifier: LGPL-2.1-or-later
"""Springs to the ground, forces and moments on boundaries: exact displacements with each solver and
in explicit dynamics, whose stable step knows of the springs."""
# ctest: goldens = springs_and_moments, springs_and_moments.mpirun=2
# ctest: label = quick

from touchstone_test import CG, GMRES, MUMPS, below, check, finish, golden, run, tests

exact = golden("springs_and_moments")
below("displacement", exact.error("displacement_l2"), 1e-9)
below("displacement, two ranks", golden("springs_and_moments", 2).error("displacement_l2"), 1e-9)
scene = tests / "springs_and_moments.prm"
for solver in MUMPS, CG, GMRES:
    below(f"displacement, {solver}", run("solver", scene, solver).error("displacement_l2"), 1e-7)
dynamic = {"Time integration/Scheme": "central_differences", "Discretisation/Degree": 1,
           "Load stepping/End time": 2}
for body in "column", "dragged", "beam":
    dynamic[f"Body {body}/Material/Density"] = 1
    dynamic[f"Body {body}/Material/Rayleigh mass"] = 5
# Loads that grow within the first half, so that the bodies come to rest.
dynamic.update({"Body column/Boundary top/Pressure": "6*min(t, 1)", "Load stepping/End time": 8,
                "Body dragged/Boundary bottom/Force x": "8*min(t, 1)",
                "Body dragged/Boundary bottom/Force y": "4*min(t, 1)",
                "Body beam/Boundary right/Moment y": "0*t",
                "Body column/Reference displacement z": "-(6/50 + 6*z/1000)",
                "Body dragged/Reference displacement x": "0.1",
                "Body dragged/Reference displacement y": "0.05",
                "Body beam/Reference displacement x": "0", "Body beam/Reference displacement z": "0"})
moved = run("explicit", scene, dynamic)
below("explicit displacement", moved.error("displacement_l2"), 1e-3)
# Springs that are stiffer than the cells set the step; without them in the bound this is unstable.
stiff = {**dynamic, "Body dragged/Boundary bottom/Spring stiffness normal": 1e5,
         "Body dragged/Boundary bottom/Spring stiffness tangential": 1e5,
         "Body dragged/Reference displacement x": "2e-5",
         "Body dragged/Reference displacement y": "1e-5"}
hard = run("stiff", scene, stiff)
below("explicit displacement, stiff springs", hard.error("displacement_l2"), 1e-3)
check(hard.count("assemblies") == 0, "explicit dynamics assembles")
finish()
