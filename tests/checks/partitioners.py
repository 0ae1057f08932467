# SPDX-License-Identifier: LGPL-2.1-or-later
"""Results do not depend on how cells are spread over ranks (1e-8), and contact that counts is
spread more evenly than contact that does not."""

from touchstone_test import FACTOR, GAP, STEPS, below, finish, prm, run, same, tests

PARTITIONER, WEIGHT = "Discretisation/Partitioner", "Discretisation/Contact weight"
SHARP = {GAP: 1e-11}


def partitions(name, scene, settings, *partitioners):
    """On three ranks as on one. Two ranks are those of the goldens."""
    one = run(name, scene, settings)
    for partitioner in partitioners:
        same(one, run(f"{name}-{partitioner}-3", scene, {**settings, PARTITIONER: partitioner}, 3),
             1e-8)
    return one


# Refined with its manifolds, and its exact surfaces: against Lame's pressure as well.
fit = {FACTOR: 2, "Body inner tube/Geometry/Cells": "3, 8, 1",
       "Body outer tube/Geometry/Cells": "3, 8, 1"}
fitted = partitions("press_fit", tests / "press_fit.prm", fit, "p4est", "coordinates", "METIS")
same(fitted, run("press_fit-METIS-1", tests / "press_fit.prm", {**fit, PARTITIONER: "METIS"}), 1e-8)
# With friction; the second from a mesh file.
partitions("sliding", tests / "hard_mu_one.prm", SHARP, "coordinates")
partitions("warped", tests / "hard_warped_master.prm", SHARP, "METIS")


def imbalance(result, phase):
    """Largest over mean of the ranks."""
    return result.value("balance", phase, "imbalance")


def spread(name, partitioner, weight):
    return run(name, prm / "two_tubes.prm", {STEPS: 1, **SHARP, PARTITIONER: partitioner,
                                             WEIGHT: weight}, 4)


def fewer_rows(a, b):
    """The busiest rank of B has fewer slave rows than that of A, by a tenth."""
    same(a, b, 1e-6)
    below(f"{b} on 4 ranks, search against {a}", imbalance(b, "search_candidates"),
          0.9 * imbalance(a, "search_candidates"))


metis = spread("metis", "METIS", 0)
fewer_rows(spread("metis-cells", "METIS, cells only", 0), metis)
curve = spread("curve", "p4est", 0)
fewer_rows(curve, spread("curve-4", "p4est", 4))
# METIS is asked for 1.03 of the cells and 1.1 of the contact work, which is slave and
# master faces together, so that rows have more room.
below("METIS on 4 ranks, cells", imbalance(metis, "cells"), 1.05)
below("METIS on 4 ranks, search", imbalance(metis, "search_candidates"), 1.5)
# Across both tubes: all ranks have their share of what is searched.
coordinates = spread("coordinates", "coordinates", 0)
below("coordinates on 4 ranks, cells", imbalance(coordinates, "cells"), 1.05)
fewer_rows(curve, coordinates)


def column(name, ranks, weight):
    """A cell that may weigh more than all the others together."""
    return run(name, prm / "patch_test.prm",
               {WEIGHT: weight, "Body lower/Geometry/Upper corner": "1, 1, 0.05",
                "Body lower/Geometry/Cells": "1, 1, 1",
                "Body upper/Geometry/Lower corner": "0, 0, 0.05",
                "Body upper/Geometry/Cells": "1, 1, 200"}, ranks)


# No rank goes without any.
same(column("column", 1, 0), column("column-heavy", 3, 1000), 1e-8)
finish()
