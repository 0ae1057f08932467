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
import typing

PATIENCE = 30 * 10**9  # nanoseconds, after which a run goes before all that came later

# Runs without mpirun would share a folder of Open MPI, which the first that ends removes.
os.environ["OMPI_MCA_orte_tmpdir_base"] = tempfile.mkdtemp(prefix="ompi")
atexit.register(shutil.rmtree, os.environ["OMPI_MCA_orte_tmpdir_base"], ignore_errors=True)


class Waiting(typing.NamedTuple):
    """A run that waits for processors, and the file by which others know of it."""
    ranks: int
    since: int  # nanoseconds
    path: pathlib.Path


def claim(ranks):
    """Wait for a processor per rank, at most all there are; returns the open files with the locks."""
    if "TOUCHSTONE_PROCESSORS" not in os.environ:
        return []
    folder = pathlib.Path(os.environ["TOUCHSTONE_PROCESSORS"])
    folder.mkdir(parents=True, exist_ok=True)
    n = len(os.sched_getaffinity(0))
    since = time.time_ns()
    me = Waiting(min(ranks, n), since, folder / f"waiting.{os.getpid()}")
    with _queue(folder):
        mine = _locked(me.path)
        mine.truncate(0)
        mine.write(f"{me.ranks} {since}")
        mine.flush()
    while True:
        with _queue(folder) as last:
            free = [file for file in (_locked(folder / str(i)) for i in range(n)) if file]
            waiting = _all_waiting(folder, me)
            start = starting(waiting, len(free), int(last.read() or 1))
            if me in start or free and not start:
                # A processor that stands idle: those that need more than one are next.
                last.truncate(0)
                last.write(str(me.ranks if me in start else max(run.ranks for run in waiting)))
            keep = free[:me.ranks] if me in start else []
            for file in free[len(keep):]:
                file.close()
            if keep:
                me.path.unlink()
                mine.close()
                return keep
        time.sleep(0.02)


def starting(waiting, free, last):
    """Those of the list WAITING that start now, with FREE processors; runs on LAST ranks go first.

    A run on two ranks needs two processors at once, and the first that is free would stand idle until
    the second is. So runs on as many ranks follow each other, until a processor finds none of them, or
    one of the others has waited for PATIENCE.
    """
    late = time.time_ns() - PATIENCE
    started = []
    for run in sorted(waiting, key=lambda run: (run.since > late, run.ranks != last, run.since)):
        if run.ranks <= free:
            free -= run.ranks
            started.append(run)
        elif run.since <= late:
            break
    return started


def _locked(path):
    """The file, opened and locked, or None if someone else has the lock."""
    file = open(path, "a+", encoding="ascii")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        file.close()
        return None
    return file


@contextlib.contextmanager
def _queue(folder):
    """The file with the number of ranks of the run that started last; one process at a time has it."""
    with open(folder / "queue", "a+", encoding="ascii") as queue:
        fcntl.flock(queue, fcntl.LOCK_EX)
        queue.seek(0)
        yield queue


def _all_waiting(folder, me):
    """All that wait. Who was killed while it waited has left a file without a lock."""
    found = [me]
    for path in folder.glob("waiting.*"):
        if path == me.path:
            continue
        if dead := _locked(path):
            path.unlink()
            dead.close()
        else:
            ranks, since = path.read_text(encoding="ascii").split()
            found.append(Waiting(int(ranks), int(since), path))
    return found


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
