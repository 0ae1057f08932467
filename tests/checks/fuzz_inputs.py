# SPDX-License-Identifier: LGPL-2.1-or-later
"""Inputs with one fault each, always the same ones, are refused with section, line and remedy, or
are right; none shows the text of a library."""

import subprocess
import sys

from touchstone_test import folder, forking_program, processors, source

with processors():
    sys.exit(subprocess.call([sys.executable, source / "contrib/fuzz_inputs", "--program", forking_program(),
                              "--output", folder, "--time-limit", "2", "30", "7"]))
