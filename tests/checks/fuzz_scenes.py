# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fixed scenes of contrib/fuzz_scenes. All converge and are as they must be, in one variant each.
Mirrored are those that once depended on the directions of the mesh: on the line that the frame of
friction followed, and on the corner of a smoothed surface; with augmented Lagrange those in which
springs turned the error of linearised gaps into forces, and a ball at the edge of its master."""

import subprocess
import sys

from touchstone_test import check, finish, folder, processors, program, source


def scenes(seed, numbers, *options):
    with processors():
        code = subprocess.call([sys.executable, source / "contrib/fuzz_scenes", "--quick", "--strict",
                                "--time-limit", "60", "--program", program, "--output", folder,
                                "--only", numbers, *options, "0", str(seed)])
    check(code == 0, f"seed {seed}: exit code {code}")


scenes(1, "0,2,6,8,9,17,19,23,24,30,33,37,39,41,43,44,50,55,56,57,60,66")
scenes(2, "70")
scenes(2, "35,47,63", "--variants", "mirrored")
scenes(2, "17,92", "--variants", "augmented lagrange")
scenes(3, "14", "--variants", "augmented lagrange")
finish()
