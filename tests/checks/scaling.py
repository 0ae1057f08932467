# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nothing that grows with the mesh goes from each rank to all others, or to one of them: counts of what
a run gathers, by a library that stands between the program and MPI (doc/scaling.md)."""

import os
import subprocess

from touchstone_test import FACTOR, STEPS, below, checks, fail, finish, launch, prm, settings_options, tests

# A contribution to a sum or a list of all: some numbers, a name, the inertia of all bodies.
FEW = 4096

subprocess.run(["mpicc", "-shared", "-fPIC", "-O1", "-o", "count_gathered.so",
                tests / "count_gathered.c"], check=True)


def gathered(name, scene, settings, ranks):
    """The largest piece, in bytes, that a rank gives to all."""
    os.environ["COUNT_GATHERED"] = os.path.abspath(name)
    os.environ["LD_PRELOAD"] = os.path.abspath("count_gathered.so")
    try:
        done = launch("--results-only", "--output", f"{name}.run",
                      *settings_options(settings), scene, ranks=ranks)
    finally:
        del os.environ["LD_PRELOAD"], os.environ["COUNT_GATHERED"]
    if done.returncode != 0:
        fail(f"{name}: exit code {done.returncode}\n{done.stdout}")
    largest = 0
    for rank in range(ranks):
        with open(f"{name}.{rank}", encoding="utf-8") as file:
            largest = max(largest, int(file.read().split()[0]))
    print(f"{name}: a rank gives {largest} bytes")
    return largest


BELOS = {"Linear solver/Type": "Belos CG", STEPS: 1, "Output/VTU interval": 1}
# Search, rows, elimination, condensation, output.
below("two tubes", gathered("tubes", prm / "two_tubes.prm", {**BELOS, FACTOR: 1.5}, 3), FEW)
# Pairs that depend on each other in a circle.
below("blocks in a circle", gathered("circle", checks / "ring.prm", {FACTOR: 2, "Output/VTU interval": 1}, 2), FEW)
finish()
