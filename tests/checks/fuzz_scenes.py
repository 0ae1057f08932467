# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fixed scenes of contrib/fuzz_scenes. All converge and are as they must be, in one variant each.
Mirrored are those that once depended on the directions of the mesh: on the line that the frame of
friction followed, and on the corner of a smoothed surface; with augmented Lagrange those in which
springs turned the error of linearised gaps into forces, and a ball at the edge of its master. Those of
seed 6 have nodes on edges between faces, a coarse slave on planes of symmetry, and bodies that only touch; that of
seed 7 has four pairs."""

import subprocess
import sys

from touchstone_test import check, finish, folder, forking_program, processors, source


def scenes(seed, numbers, *options):
    with processors():
        code = subprocess.call([sys.executable, source / "contrib/fuzz_scenes", "--quick", "--strict",
                                "--time-limit", "60", "--program", forking_program(), "--output", folder,
                                "--only", numbers, *options, "0", str(seed)])
    check(code == 0, f"seed {seed}: exit code {code}")


scenes(1, "0,2,6,9,17,19,23,24,30,33,37,43,44,50,55,56,57,60")
scenes(6, "26,38,44,67,69,89")
scenes(2, "35,47,63", "--variants", "mirrored")
scenes(2, "17,92", "--variants", "augmented lagrange")
scenes(3, "14", "--variants", "augmented lagrange")
scenes(7, "27")
finish()
