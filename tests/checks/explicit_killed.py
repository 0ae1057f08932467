# SPDX-License-Identifier: LGPL-2.1-or-later
"""An explicit run that is killed at random places and resumed: the same bits in statistics, summary
and VTU files as those of one that was not (doc/explicit.md, section 7).

    PLACES=20 python3 explicit_killed.py PROGRAM PROJECT FOLDER

kills at 20 places, on one and two ranks in turn; ctest at three."""

import contextlib
import os
import random
import shutil
import signal
import subprocess
import time

from touchstone_test import (STEPS, Run, check, checks, finish, folder, processors, program,
                             session, settings_options)

BLOCKS = checks / "explicit_blocks.prm"
STEPS_OF_RUN = 30
SETTINGS = {"Output/VTU interval": 5, "Checkpoints/Steps between": 1, STEPS: STEPS_OF_RUN,
            "Load stepping/End time": 1.5}


def newest_checkpoint(name):
    """Number of the newest complete checkpoint, 0 without any."""
    return max([0, *(int(path.name.split("_")[1]) for path in
                     (folder / name).glob("checkpoint_[0-9]*") if path.suffix != ".part")])


def attempt(name, ranks, checkpoint=None, delay=0, resume=False):
    """Run, but no longer than DELAY seconds after a CHECKPOINT. @return whether the run came to its
    end."""
    command = [*(["mpirun", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []), program,
               "--results-only", "--output", name, *(["--resume"] if resume else []),
               *settings_options(SETTINGS), BLOCKS]
    with processors(ranks), open(folder / f"{name}.log", "a", encoding="utf-8") as log:
        with subprocess.Popen(list(map(str, command)), stdout=log, stderr=subprocess.STDOUT,
                              start_new_session=True) as running:
            if checkpoint is None:
                return running.wait() == 0
            while running.poll() is None and newest_checkpoint(name) < checkpoint:
                time.sleep(1e-3)
            time.sleep(delay)
            for victim in session(running.pid):
                with contextlib.suppress(ProcessLookupError):
                    os.kill(victim, signal.SIGKILL)
            return running.wait() == 0


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


places = int(os.environ.get("PLACES", 3))
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
    checkpoint = random.randrange(STEPS_OF_RUN - 4)
    if not attempt(name, ranks, checkpoint, random.uniform(0, lasts[ranks] / STEPS_OF_RUN)):
        kills += 1
        # Before the first checkpoint there is nothing to resume.
        resume = newest_checkpoint(name) > 0
        resumes += resume
        check(attempt(name, ranks, resume=resume), f"{name}, place {place}: the run has failed")
    for what, was, now in zip(("statistics", "VTU", "summary"), whole[ranks], outputs(name)):
        check(was == now, f"{name}, place {place}: other bits in {what}")
print(f"{kills} kills at {places} places, {resumes} resumed")
check(resumes > 0, "no run was killed between two checkpoints")
finish()
