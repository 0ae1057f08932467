# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shipped scenes with features that they do not have, always the same ones: what converges has the
same result on two ranks and with another exact formulation, and nothing ends without a reason."""

import subprocess
import sys

from touchstone_test import folder, forking_program, processors, source

with processors():
    sys.exit(subprocess.call([sys.executable, source / "contrib/fuzz_features", "--program", forking_program(),
                              "--output", folder, "12", "1"]))
