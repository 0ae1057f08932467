# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nothing that grows with the mesh goes from each rank to all others, or to one of them: counts of what
a run gathers, by a library that stands between the program and MPI (doc/scaling.md)."""

import json
import os
import subprocess

from touchstone_test import (FACTOR, GAP, RESIDUAL, STEPS, below, check, checks, fail, finish, folder, launch, prm,
                             settings_options, tests)

PLATE = """subsection Body {name}
  set Fixed = {side}
  subsection Geometry
    set Type = box
    set Lower corner = 0, 0, {start}
    set Upper corner = 1, 1, {end}
    set Cells = {cells}, {cells}, 1
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.3
  end
end
"""
# Two plates, the master's of many nodes, apart by more than what is searched.
APART = """
set Bodies = upper, lower
set Contact pairs = c
""" + PLATE.format(name="upper", side="top", start=5, end=6, cells=2) + PLATE.format(
    name="lower", side="bottom", start=0, end=0.1, cells=24) + """
subsection Contact pair c
  set Slave body = upper
  set Slave boundaries = bottom
  set Master body = lower
  set Master boundaries = top
end
"""

# A contribution to a sum or a list of all: some numbers, a name, the inertia of all bodies.
FEW = 4096

subprocess.run(["mpicc", "-shared", "-fPIC", "-O1", "-o", "count_gathered.so",
                tests / "count_gathered.c", "-ldl"], check=True)


def counts(name, scene, settings, ranks):
    """Of a run: the largest piece, in bytes, that a rank gives to all; lists of all ranks that the
    program asks for; sums and maxima; and Newton iterations."""
    os.environ["COUNT_GATHERED"] = os.path.abspath(name)
    os.environ["LD_PRELOAD"] = os.path.abspath("count_gathered.so")
    try:
        done = launch("--results-only", "--output", f"{name}.run",
                      *settings_options(settings), scene, ranks=ranks)
    finally:
        del os.environ["LD_PRELOAD"], os.environ["COUNT_GATHERED"]
    if done.returncode != 0:
        fail(f"{name}: exit code {done.returncode}\n{done.stdout}")
    ranks = [[int(word) for word in open(f"{name}.{rank}", encoding="utf-8").read().split()]
             for rank in range(ranks)]
    with open(f"{name}.run/summary.json", encoding="utf-8") as file:
        newton = json.load(file)["iterations"]["newton"]
    result = [max(numbers) for numbers in zip(*ranks)] + [newton]
    print("{}: a rank gives {} bytes, {} lists, {} reductions, {} iterations".format(name, *result))
    return result


def gathered(name, scene, settings, ranks):
    """The largest piece, in bytes, that a rank gives to all."""
    return counts(name, scene, settings, ranks)[0]


BELOS = {"Linear solver/Type": "Belos CG", STEPS: 1, "Output/VTU interval": 1}
# Search, rows, elimination, condensation, output.
below("two tubes", gathered("tubes", prm / "two_tubes.prm", {**BELOS, FACTOR: 1.5}, 3), FEW)
# Pairs that depend on each other in a circle.
below("blocks in a circle", gathered("circle", checks / "ring.prm", {FACTOR: 2, "Output/VTU interval": 1}, 2), FEW)
apart = folder / "apart.prm"
apart.write_text(APART, encoding="utf-8")
# Bodies that are far from each other at the start: do they face each other?
below("far apart", gathered("apart", apart, {}, 3), FEW)

# What an iteration adds: of lists of all ranks none; of sums and maxima those by which the libraries
# agree on the layout of vectors and matrices, and few of our own (those of MUMPS, in Fortran, do not
# count). 140 when each norm was a sum of its own.
MUMPS = {"Linear solver/Type": "MUMPS", STEPS: 1, "Output/VTU interval": 0}
rough = counts("rough", prm / "two_tubes.prm", {**MUMPS, RESIDUAL: 5e-3, GAP: 5e-3}, 2)
fine = counts("fine", prm / "two_tubes.prm", {**MUMPS, RESIDUAL: 1e-11}, 2)
more = fine[3] - rough[3]
check(more > 0, f"the second run has {more} iterations more than the first")
below("lists of all ranks that more iterations add", max(fine[1] - rough[1], 0), 0.5)
below("sums and maxima in an iteration", (fine[2] - rough[2]) / more, 125)
finish()
