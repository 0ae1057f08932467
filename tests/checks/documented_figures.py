# SPDX-License-Identifier: LGPL-2.1-or-later
"""Figures in doc that a quick run can reproduce are what the runs give."""

import subprocess
import sys

from touchstone_test import forking_program, processors, source

with processors():
    sys.exit(subprocess.call([sys.executable, source / "contrib/check_figures", "--program", forking_program()]))
