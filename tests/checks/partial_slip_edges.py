# SPDX-License-Identifier: LGPL-2.1-or-later
"""Partial slip on a mesh that follows the edges of stick and contact, as contrib/record_table.sh
has it: a run on a coarse mesh finds the edges, and the next has half of its error."""

import math
import shutil
import subprocess
import sys

from touchstone_test import below, check, finish, folder, run, source

RADIUS, MODULUS, FRICTION, DEPTH = 10000 / 2, 210000 / (2 * (1 - 0.09)), 0.3, 0.25
shutil.copy(source / "contrib/record_partial_slip.prm", folder / "partial_slip.prm")


def slip(name, edges, *sizes):
    """Run on a mesh with these edges, and the half-widths of stick and contact that it finds."""
    *sizes, layer = map(str, sizes)
    subprocess.run([sys.executable, source / "contrib/graded_cylinders.py", folder / "cylinders.msh",
                    ",".join(f"{e:.5f}" for e in edges), *sizes, f"layer={layer}", "outer=2",
                    f"radius={2 * RADIUS}", "width=200", "height=200"], check=True)
    result = run(name, folder / "partial_slip.prm")
    force = [abs(f) / DEPTH for f in result.force("contact")]
    normal, fraction = force[2], force[0] / (FRICTION * force[2])
    a = math.sqrt(4 * normal * RADIUS / (math.pi * MODULUS))
    return result, (a * math.sqrt(1 - fraction), a)


coarse, edges = slip("coarse", (0.5, 0.75), 0.02, 0.1, 1.5, 1.4)
fine, found = slip("fine", edges, 0.01, 0.05, 1.3, 1.3)
for result, shear, pressure in (coarse, 0.018, 0.008), (fine, 0.007, 0.003):
    below(f"{result}, shear_traction_field_l2", result.error("shear_traction_field_l2"), shear)
    below(f"{result}, pressure_field_l2", result.error("pressure_field_l2"), pressure)
check(all(abs(a / b - 1) < 1e-3 for a, b in zip(edges, found)), f"edges {edges} become {found}")

# It is the place of the edges that counts.
off, _ = slip("off", [0.93 * e for e in edges], 0.01, 0.05, 1.3, 1.3)
ratio = off.error("shear_traction_field_l2") / fine.error("shear_traction_field_l2")
check(ratio > 1.5, f"edges off by 7 % have {ratio:.2f} times the error")
finish()
