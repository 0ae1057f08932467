# SPDX-License-Identifier: LGPL-2.1-or-later
"""processors.py RANKS COMMAND...: run a command as soon as a processor per rank is free.

Ranks that wait for each other while others have the processor make a run of a second take a minute,
and most checks make runs on one rank and on several: so it is each run, and not each test, that claims
its processors. ctest may be given more jobs than there are processors. Files of the folder
TOUCHSTONE_PROCESSORS, an environment variable that ctest sets, stand for the processors; the lock of a
file is lost when the process ends, however that happens. Without the folder nobody waits.
"""

import atexit
import contextlib
import fcntl
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

# Runs without mpirun would share a folder of Open MPI, which the first that ends removes.
os.environ["OMPI_MCA_orte_tmpdir_base"] = tempfile.mkdtemp(prefix="ompi")
atexit.register(shutil.rmtree, os.environ["OMPI_MCA_orte_tmpdir_base"], ignore_errors=True)


def claim(ranks):
    """Wait for a processor per rank, at most all there are; returns the open files with the locks."""
    if "TOUCHSTONE_PROCESSORS" not in os.environ:
        return []
    folder = pathlib.Path(os.environ["TOUCHSTONE_PROCESSORS"])
    folder.mkdir(parents=True, exist_ok=True)
    n = len(os.sched_getaffinity(0))
    free = [open(folder / str(i), "w", encoding="ascii") for i in range(n)]
    held = []
    # One at a time takes processors: nobody with one waits for a second that another waits with.
    with open(folder / "queue", "w", encoding="ascii") as queue:
        fcntl.flock(queue, fcntl.LOCK_EX)
        while True:
            for file in [file for file in free if file not in held]:
                with contextlib.suppress(BlockingIOError):
                    fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                    held.append(file)
                if len(held) == min(ranks, n):
                    for rest in set(free) - set(held):
                        rest.close()
                    return held
            time.sleep(0.01)


@contextlib.contextmanager
def processors(ranks=1):
    """Hold a processor per rank within a block."""
    held = claim(ranks)
    try:
        yield
    finally:
        for file in held:
            file.close()


if __name__ == "__main__":
    with processors(int(sys.argv[1])):
        code = subprocess.call(sys.argv[2:])
    sys.exit(code)
