# SPDX-License-Identifier: LGPL-2.1-or-later
"""Exact and manufactured solutions whose contact pressure varies along the interface, each on four
meshes (doc/benchmarks.md, "Rates of convergence"). The exponents of displacement and contact
pressure in the cell size, errors in the norm of L2, are fitted by least squares and have lower
bounds. Writes the table of the page to table.md."""

import math
import re

from touchstone_test import DEGREE, check, checks, finish, folder, run, same

table = ["| solution | displacement | rate | pressure | rate |", "|---|---|---|---|---|"]


def exponent(sizes, errors):
    """Fitted by least squares; not a number if an error is none."""
    if not all(e > 0 for e in errors):
        return math.nan
    x, y = [math.log(k) for k in sizes], [-math.log(e) for e in errors]
    n, mean_x, mean_y = len(x), sum(x) / len(x), sum(y) / len(y)
    return sum((x[i] - mean_x) * (y[i] - mean_y) for i in range(n)) / \
        sum((xi - mean_x) ** 2 for xi in x)


def cells(pattern, k):
    """'3*k, 1' with its products computed."""
    return re.sub(r"(\d+)\*k", lambda m: str(int(m[1]) * k), pattern)


def rates(title, name, degree, displacement, pressure, master, slave, meshes=(1, 2, 4, 8)):
    """The fitted exponents are at least DISPLACEMENT and PRESSURE. MASTER and SLAVE are the cells
    of the bodies with k for the number of the mesh."""
    bodies = ("inner", "outer") if name == "curved" else ("lower", "upper")
    runs = [run(f"{name}_{degree}_{k}", checks / f"rates_{name}.prm",
                {DEGREE: degree, f"Body {bodies[0]}/Geometry/Cells": cells(master, k),
                 f"Body {bodies[1]}/Geometry/Cells": cells(slave, k)}) for k in meshes]
    row = f"| {title} |"
    for what, error, bound in (("displacement", "displacement_l2", displacement),
                               ("pressure", "pressure_l2", pressure)):
        errors = [r.error(error) for r in runs]
        rate = exponent(meshes, errors)
        print(f"{title}, {what}: exponent {rate:.2f}, at least {bound}", flush=True)
        check(rate >= bound, f"{title}, {what}: exponent {rate:.4f} is less than {bound}")
        row += f" {errors[0]:.1e} to {errors[-1]:.1e} | {rate:.2f} |"
    table.append(row)


rates("flat, matching", "wave", 1, 1.9, 1.5, "4*k, 1, 4*k", "4*k, 1, 4*k")
rates("flat, 3 : 2", "wave", 1, 1.9, 1.5, "6*k, 1, 6*k", "4*k, 1, 4*k")
rates("flat, 3 : 2, degree 2", "flat", 2, 2.4, 1.5, "3*k, 1, 3*k", "2*k, 1, 2*k", (1, 2, 4, 6))
rates("friction, 3 : 2", "friction", 1, 1.9, 1.5, "6*k, 1, 6*k", "4*k, 1, 4*k")
rates("curved, matching", "curved", 1, 1.9, 1.0, "2*k, 4*k, 1", "2*k, 4*k, 1")
rates("curved, 3 : 2", "curved", 1, 1.9, 1.0, "3*k, 6*k, 1", "2*k, 4*k, 1")
rates("curved, 3 : 2, degree 2", "curved", 2, 2.4, 1.5, "3*k, 6*k, 1", "2*k, 4*k, 1", (1, 2, 3, 4))
# The pressure has a slope at the edges of the slave surface, where nodal pressures are of the
# first order in the cell size: the exponent tends to 1.5 from below.
rates("in space, 3 : 2, with edges", "space", 1, 1.9, 1.4, "3*k, 3*k, 3*k", "2*k, 2*k, 2*k",
      (1, 2, 3, 4))

# Integrals are the same on any number of ranks.
same(run("one", checks / "rates_friction.prm"), run("two", checks / "rates_friction.prm", None, 2),
     1e-8)
(folder / "table.md").write_text("\n".join(table) + "\n", encoding="utf-8")
print("\n".join(table))
finish()
