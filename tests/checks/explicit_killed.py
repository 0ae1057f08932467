# SPDX-License-Identifier: LGPL-2.1-or-later
"""An explicit run that is killed at random places and resumed: the same bits in statistics, summary
and VTU files as those of one that was not (doc/explicit.md, section 7).

    python3 explicit_killed.py PROGRAM PROJECT FOLDER [PLACES]

kills at PLACES places, 20 for instance, on one and two ranks in turn; ctest at three."""

import os
import random
import shutil
import signal
import subprocess
import sys
import time

from touchstone_test import (Run, check, checks, finish, folder, processors, program,
                             settings_options)

BLOCKS = checks / "explicit_blocks.prm"
SETTINGS = {"Output/VTU interval": 5, "Checkpoints/Steps between": 1, "Load stepping/Steps": 30,
            "Load stepping/End time": 1.5}


def attempt(name, ranks, seconds=None, resume=False):
    """Run, but no longer than that. @return whether the run came to its end."""
    command = [*(["mpirun", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []), program,
               "--results-only", "--output", name, *(["--resume"] if resume else []),
               *settings_options(SETTINGS), BLOCKS]
    with processors(ranks), open(folder / f"{name}.log", "a", encoding="utf-8") as log:
        with subprocess.Popen(list(map(str, command)), stdout=log, stderr=subprocess.STDOUT,
                              start_new_session=True) as running:
            try:
                return running.wait(seconds) == 0
            except subprocess.TimeoutExpired:
                pass
            # mpirun and ranks are in one session, but not in one group of processes.
            victims = subprocess.run(["ps", "-o", "pid=", "-s", str(running.pid)], check=False,
                                     stdout=subprocess.PIPE, text=True).stdout.split()
            for victim in victims:
                try:
                    os.kill(int(victim), signal.SIGKILL)
                except ProcessLookupError:
                    pass
            return False


def outputs(name):
    """All numbers that a run has written."""
    result = Run(name, folder / name, "")
    files = {path.name: path.read_bytes().split(b"-->")[-1]
             for path in sorted((folder / name).glob("*.vtu"))}
    return ((folder / name / "statistics").read_text(encoding="utf-8"), files,
            {key: result.summary.get(key) for key in ("motion", "results", "cycles", "errors")})


def fresh(name):
    """An empty folder of results."""
    shutil.rmtree(folder / name, ignore_errors=True)
    (folder / f"{name}.log").unlink(missing_ok=True)


places = int(sys.argv[4]) if len(sys.argv) > 4 else 3
random.seed(22)
whole, lasts = {}, {}
for ranks in (1, 2):
    fresh(f"whole-{ranks}")
    begin = time.monotonic()
    check(attempt(f"whole-{ranks}", ranks), f"the run on {ranks} ranks has failed")
    whole[ranks], lasts[ranks] = outputs(f"whole-{ranks}"), time.monotonic() - begin
check(len(whole[1][1]) >= 6, "no VTU files")
kills = resumes = 0
for place in range(places):
    ranks = 1 + place % 2
    name = f"killed-{ranks}"
    fresh(name)
    if not attempt(name, ranks, random.uniform(0.2, 1) * lasts[ranks]):
        kills += 1
        # Before the first checkpoint there is nothing to resume.
        resume = any((folder / name).glob("checkpoint_[0-9]*"))
        resumes += resume
        check(attempt(name, ranks, resume=resume), f"{name}, place {place}: the run has failed")
    for what, was, now in zip(("statistics", "VTU", "summary"), whole[ranks], outputs(name)):
        check(was == now, f"{name}, place {place}: other bits in {what}")
print(f"{kills} kills at {places} places, {resumes} resumed")
check(kills > 0, "no run was killed")
finish()
