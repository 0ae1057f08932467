# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the shipped scenes of large deformation, plasticity and impact promise, on meshes that are
quick."""

import re

from touchstone_test import DEGREE, FACTOR, STEPS, below, check, finish, prm, resume, run, same

BENCHMARKS = prm / "benchmarks"


def errors(result, **bounds):
    for name, bound in bounds.items():
        below(f"{result}, {name}", result.error(name), bound)


# Loaded, and unloaded again: the residual stress. Errors fall with the cells.
hill = BENCHMARKS / "hill_tube.prm"
values = re.search("^ *set Values = (.*)", hill.read_text(encoding="utf-8"), re.M)[1]
loaded = run("hill", hill, {"Checkpoints/Steps between": 10})
errors(loaded, contact_pressure_mean=1e-3, elastic_plastic_radius=2e-3, stress_l2=0.005)
errors(resume("residual", loaded.folder, hill, {"Load stepping/End time": 2, STEPS: 20,
                                                "Reference solution/Values": f"{values}, unloaded: 1"}),
       elastic_plastic_radius=2e-3, stress_l2=0.01)

# Near-incompressible: full integration of degree 1 locks and misses by half.
cook = BENCHMARKS / "cook.prm"
errors(run("f_bar", cook, {"Body membrane/Geometry/Cells": "16, 16, 1"}), point_displacement=0.012)
errors(run("degree_2", cook, {"Body membrane/Geometry/Cells": "8, 8, 1", DEGREE: 2}),
       point_displacement=0.045)

# The plate and Taylor's bar, coarse and for a while: the same on two ranks, energies add up. With a
# factor of 0.25 the slave nodes of the plate would lie beside the edge that it falls on.
plates = [run(f"plate_{ranks}", prm / "plate_drop.prm",
              {FACTOR: 0.5, "Load stepping/End time": 5e-7, STEPS: 25}, ranks) for ranks in (1, 2)]
rods = [run(f"taylor_{ranks}", BENCHMARKS / "taylor_bar.prm",
            {"Body rod/Geometry/Cells": "2, 2, 12", "Load stepping/End time": 2e-6, STEPS: 10}, ranks)
        for ranks in (1, 2)]
same(*plates, 1e-6)
same(*rods, 1e-4)
# All ranks integrate the plastic cells before any of them goes on to the solution: each has its share
# of them and of the linear ones of the ground. p4est balances the sum, to which plastic cells count more.
for phase in "cells", "unknowns":
    below(f"plate_2, {phase}", plates[1].value("balance", phase, "imbalance"), 1.1)
curve = run("plate_curve", prm / "plate_drop.prm",
            {FACTOR: 0.5, "Load stepping/End time": 1e-8, STEPS: 1, "Discretisation/Partitioner": "p4est"}, 2)
share = curve.value("balance", "cells", "imbalance")
check(share >= 1.1, f"plate_curve: cells of a rank over the mean {share}, but not 1.1 or more")
finish()
