# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every 100 cycles a tool that knows nothing of the program looks for surfaces that cross: the strip that a
piston crumples, the mat that is twisted, and a tube that is crushed (doc/general_contact.md, section 9; the other
scenes are so short that the checks which run them do so)."""
# ctest: label = nightly

import subprocess
import sys
from pathlib import Path

from touchstone_test import STEPS, below, check, finish, folder, run
import crossings  # of tests/, which touchstone_test finds

PROGRAM, PROJECT = sys.argv[1:3]
MOST_CYCLES = 100
for name, *arguments in ("explicit_crumpled", 60, 25, 150), ("explicit_resting", 100):
    script = Path(__file__).with_name(f"{name}.py")
    text = subprocess.run([sys.executable, script, PROGRAM, PROJECT, folder / name, *map(str, arguments)],
                          check=False, capture_output=True, text=True)
    print(text.stdout)
    check(text.returncode == 0, f"{name}: exit code {text.returncode}, {text.stderr[-300:]}")
    cycles = [line.split(":")[1] for line in text.stdout.splitlines() if "cycles between results:" in line]
    below(f"{name}, cycles between results", float(cycles[0]) if cycles else 1e9, MOST_CYCLES)

# Coarser than the scene. With these output intervals edges in the plane of symmetry of a fold met, which have
# no normal within it: their motion across it is round-off, which no row and no shorter cycle takes away.
tube = run("tube", Path(PROJECT) / "prm/benchmarks/crushed_tube.prm",
           {"Body tube/Geometry/Cells": "2, 8, 30", STEPS: 115, "Load stepping/End time": 1e-3}, vtu=1)
below("tube, cycles between results", max(tube.column("cycles")), MOST_CYCLES)
files = sorted(tube.folder.glob("solution_*.vtu"))
check(len(files) >= 115, f"tube: {len(files)} results written")
for path in files:
    places = crossings.find(path, mirrored=((0, 0), (1, 0)))
    check(not places, f"tube: {len(places)} crossings in {path.name}, the first at {places[:1]}")
finish()
