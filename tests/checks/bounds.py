# SPDX-License-Identifier: LGPL-2.1-or-later
"""The accuracy that the shipped scenes promise. A golden can be made anew by mistake, these bounds
cannot."""
# ctest: goldens = hill_tube_elastic, imported_mesh, press_fit_built_in, beam_incompatible_modes
# ctest: goldens = beam_degree_2, nearly_incompressible_b_bar, nearly_incompressible_modes
# ctest: goldens = nearly_incompressible_degree_2, cylinder_inside, cylinder_outside

from touchstone_test import DEGREE, FACTOR, below, finish, golden, prm, relative, run, tests


def errors(result, **bounds):
    for name, bound in bounds.items():
        below(f"{result}, {name}", result.error(name), bound)
    return result


errors(run("press_fit", prm / "press_fit.prm"), contact_pressure_mean=1e-3,
       contact_pressure_max_deviation=5e-3)
# FE_Q(2), 1,122 nodes.
errors(run("degree_2", prm / "press_fit.prm", {DEGREE: 2, "Body inner tube/Geometry/Cells": "5, 8, 1",
                                               "Body outer tube/Geometry/Cells": "5, 8, 1"}),
       contact_pressure_mean=1e-4)
# Meshes 4:3; outer tube (slave) fine, then coarse.
for name, body in ("fine_slave", "inner"), ("coarse_slave", "outer"):
    errors(run(name, prm / "press_fit.prm", {f"Body {body} tube/Geometry/Cells": "16, 36, 6"}),
           contact_pressure_mean=1e-2)

for scene in "hertz_sphere", "hertz_rigid_plane":
    errors(run(scene, prm / f"{scene}.prm"), peak_pressure=0.015, contact_radius=0.05,
           pressure_l2=0.03)

# Before it yields Hill's tube is Lame's; the error halves with the cells.
errors(golden("hill_tube_elastic"), contact_pressure_mean=2e-3, stress_l2=0.0105)
errors(run("hill_tube_fine", tests / "hill_tube_elastic.prm", {FACTOR: 2}),
       contact_pressure_mean=5e-4, stress_l2=0.0052)

# The imported mesh gives the same answer as the built-in geometry.
imported, built_in = golden("imported_mesh"), golden("press_fit_built_in")
for figure in "area", "max_pressure", "active":
    below(f"imported_mesh, {figure} differs from that of the built-in geometry",
          relative(imported.contact("fit", figure), built_in.contact("fit", figure)), 1e-8)
for figure in "force", "moment":
    for i in 0, 1:
        below(f"imported_mesh, {figure} {i} differs from that of the built-in geometry",
              relative(imported.value("results", "contact", "fit", figure, i),
                       built_in.value("results", "contact", "fit", figure, i)), 1e-8)

# Elements: what locks and what does not.
errors(golden("beam_incompatible_modes"), point_displacement=0.01)
errors(golden("beam_degree_2"), point_displacement=0.005)
for name in ("nearly_incompressible_b_bar", "nearly_incompressible_modes",
             "nearly_incompressible_degree_2", "cylinder_inside", "cylinder_outside"):
    errors(golden(name), contact_pressure_mean=1e-2)
finish()
