# SPDX-License-Identifier: LGPL-2.1-or-later
"""A run that a signal ends says so, has its own exit code and a checkpoint without being asked for
one, and goes on with --resume to the result of a run that was not interrupted: SIGTERM, SIGINT to
one of two ranks, SIGUSR1 by way of mpirun; implicit and explicit; in a later step and in the
first, after which only the initial state is there to go on from."""

import os
import shutil
import signal
import subprocess

from touchstone_test import (GAP, RESIDUAL, STEPS, Run, check, checks, finish, folder, launch,
                             processors, program, run, same, session, settings_options)

IMPLICIT = checks / "restart.prm", {STEPS: 12, RESIDUAL: 1e-12, GAP: 1e-11}
# Of elastic cells, whose stable step is known at once: others find theirs on the way.
EXPLICIT = checks / "explicit_bars.prm", {STEPS: 60}
INTERRUPTED = 5


def interrupt(name, scene, settings, number, ranks=1, one_rank=False, step=4, afresh=True):
    """Send the signal NUMBER when STEP begins. @return what the run has said, and its exit code."""
    if afresh:
        shutil.rmtree(folder / name, ignore_errors=True)
    command = [*(["mpirun", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []), program,
               "--output", name, *settings_options(settings), scene]
    text = ""
    with processors(ranks), subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE,
                                             stderr=subprocess.STDOUT, text=True,
                                             start_new_session=True) as running:
        for line in running.stdout:
            text += line
            if line.startswith(f"Step {step}/"):
                victim = running.pid
                if one_rank:
                    victim = max(member for member in session(running.pid)
                                 if member != running.pid)
                os.kill(victim, number)
        code = running.wait()
    return text, code


def goes_on(name, scene, settings, number, whole, **how):
    text, code = interrupt(name, scene, settings, number, **how)
    signal_name = signal.Signals(number).name
    check(code == INTERRUPTED, f"{name}: exit code {code}, {text[-500:]}")
    check(f"Interrupted: ended by the signal {signal_name} in step" in text and
          "--resume" in text, f"{name}: the reason is not said: {text[-500:]}")
    check("did not converge" not in text and "Try more" not in text, f"{name}: advice on Newton: {text[-500:]}")
    failure = Run(name, folder / name, "").summary.get("failure", "")
    check(signal_name in failure, f"{name}: summary.json says {failure}")
    check(any((folder / name).glob("checkpoint_*")), f"{name}: no checkpoint")
    done = launch("--resume", "--output", name, *settings_options(settings), scene,
                  ranks=how.get("ranks", 1))
    check(done.returncode == 0 and "goes on from" in done.stdout, f"{name}: {done.stdout}")
    same(whole, Run(name, folder / name, done.stdout), 1e-10)


scene, settings = IMPLICIT
whole = run("implicit-whole", scene, settings)
goes_on("implicit-term", scene, settings, signal.SIGTERM, whole)
goes_on("implicit-int-2", scene, settings, signal.SIGINT, whole, ranks=2, one_rank=True)
goes_on("implicit-usr1-2", scene, settings, signal.SIGUSR1, whole, ranks=2)
goes_on("implicit-first", scene, settings, signal.SIGTERM, whole, step=1)

# A first step that does not converge goes on with other settings, too.
few = {**settings, "Checkpoints/Steps between": 5, "Newton/Maximum iterations": 1, "Load stepping/Maximum cuts": 0}
shutil.rmtree(folder / "failed-first", ignore_errors=True)  # checkpoints of an earlier time
failed = launch("--output", "failed-first", *settings_options(few), scene)
check(failed.returncode == 2, f"failed-first: exit code {failed.returncode}")
done = launch("--resume", "--output", "failed-first", *settings_options(settings), scene)
check(done.returncode == 0 and "step 0 at time 0" in done.stdout, f"failed-first: {done.stdout}")
same(whole, Run("failed-first", folder / "failed-first", done.stdout), 1e-10)

scene, settings = EXPLICIT
whole = run("explicit-whole", scene, settings)
goes_on("explicit-term", scene, settings, signal.SIGTERM, whole)
goes_on("explicit-first", scene, settings, signal.SIGTERM, whole, step=1)

# The initial state takes the place of no checkpoint that an earlier run has left.
before = sorted((folder / "implicit-term").glob("checkpoint_*"))
text, code = interrupt("implicit-term", *IMPLICIT, signal.SIGTERM, step=1, afresh=False)
check(code == INTERRUPTED and f"would go on from {before[-1].name}, which an earlier run" in text,
      f"earlier run: {code}, {text[-500:]}")
check(sorted((folder / "implicit-term").glob("checkpoint_*")) == before,
      "a run that was ended in its first step has taken checkpoints of an earlier one away")
finish()
