# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs that are stopped and resumed are those that are not: to the last bit on the same ranks, to
1e-10 on others, whenever and however they are stopped; what does not fit is refused. On several
ranks MUMPS adds up what arrives first, so that even the same run can differ in its last bits:
there 1e-10 counts, and the bits with Belos."""

import os
import re
import shutil
import signal
import subprocess
import time

from touchstone_test import (AUGMENTED, GAP, GMRES, MULTIPLIERS, RESIDUAL, STEPS, Run, check, checkpoints, checks,
                             fail, finish, folder, launch, lose_last_checkpoint, processors, program, same,
                             settings_options, tests)

scene, plate = checks / "restart.prm", checks / "thin_plate.prm"
adaptive = tests / "adaptive_sliding.prm"
EVERY_3 = {"Output/VTU interval": 3}
EVERY_4 = {"Checkpoints/Steps between": 4}
PAIRING = "Contact pair contact/Pairing"


def start(name, file, settings=None, ranks=1, resume=False):
    """The program, into a folder that may exist. True if it converged."""
    done = launch("--results-only", "--output", name, *(["--resume"] if resume else []),
                  *settings_options(settings or {}), file, ranks=ranks)
    (folder / f"{name}.txt").write_text(done.stdout, encoding="utf-8")
    return done.returncode == 0


def said(name):
    return (folder / f"{name}.txt").read_text(encoding="utf-8")


def fresh(name):
    shutil.rmtree(folder / name, ignore_errors=True)
    return name


def died(name, copy):
    """A copy of a run as if it had died: without the newest checkpoint, with a row and a
    VTU file too many."""
    shutil.copytree(folder / name, folder / fresh(copy))
    lose_last_checkpoint(folder / copy)


def lasting(name):
    """summary.json without what differs from run to run: times, memory, and the balance of the
    work since the program began."""
    summary = dict(Run(name, folder / name, "").summary)
    for key in "seconds", "peak_memory_mb", "balance":
        summary.pop(key, None)
    return summary


def content(path):
    """Of a PVD file but for the date in a comment."""
    text = path.read_bytes()
    if path.suffix == ".pvd":
        lines = text.splitlines()
        text = b"\n".join(x for x in lines if not re.search(rb"^#|generated|^-->", x))
    return text


def goes_on(name, file, settings=None, ranks=1):
    """A run with checkpoints, and another that is stopped after the last but one and resumed:
    all files are the same."""
    settings = {**EVERY_3, **(settings or {})}
    resumed = f"{name}-resumed"
    if not start(fresh(name), file, settings, ranks):
        fail(f"{name}: {said(name)}")
        return
    check(len(checkpoints(name)) == 2, f"{name}: not two checkpoints")
    died(name, resumed)
    if not start(resumed, file, settings, ranks, resume=True):
        fail(f"{resumed}: {said(resumed)}")
        return
    check(lasting(name) and lasting(name) == lasting(resumed), f"{name}: another summary")
    files = [p for p in sorted((folder / name).iterdir())
             if p.name == "statistics" or p.suffix in (".vtu", ".pvd")]
    check(len(files) > 3, f"{name}: hardly any files")
    for path in files:
        check(content(path) == content(folder / resumed / path.name), f"{name}: another {path.name}")
    Run(resumed, folder / resumed, "").says("goes on from checkpoint_")
    print(f"{name}: bitwise the same on {ranks} rank(s)", flush=True)


def other(name, ranks, file, settings=None):
    """A run resumed on other ranks."""
    copy = f"{name}-on-{ranks}"
    died(name, copy)
    check(start(copy, file, settings, ranks, resume=True), f"{copy}: {said(copy)}")
    same(Run(name, folder / name, ""), Run(copy, folder / copy, ""), 1e-10)


# All that has a history: each enforcement, both pairings, both friction formulations, large
# strain, obstacles, cut steps, inertia of a thin plate, changed meshes, both kinds of solvers.
goes_on("elimination", scene)
goes_on("multipliers", scene, {**MULTIPLIERS, "Contact pair contact/Master normal": "smoothed"})
goes_on("augmented", scene, {**AUGMENTED, "Body block/Material/Law": "neo-Hookean"})
goes_on("pointwise", scene, {PAIRING: "pointwise", "Contact/Friction": "regularised", **GMRES})
goes_on("frictionless", tests / "moving_plane.prm", {"Checkpoints/Steps between": 3})
goes_on("cut", scene, {"Newton/Maximum iterations": 6, RESIDUAL: 1e-8,
                       "Newton/Gap tolerance": 1e-6})
goes_on("plate", plate, {STEPS: 2, "Checkpoints/Steps between": 1})
goes_on("adaptive", adaptive, {**EVERY_4, RESIDUAL: 1e-11, GAP: 1e-11})
goes_on("metis-2", scene, {"Discretisation/Partitioner": "METIS", **GMRES}, 2)
goes_on("adaptive-2", adaptive, {**EVERY_4, "Discretisation/Contact weight": 4, **GMRES,
                                 RESIDUAL: 1e-11, GAP: 1e-11}, 2)

check(start(fresh("elimination-2"), scene, EVERY_3, 2), "elimination-2")
other("elimination-2", 2, scene)
other("elimination-2", 1, scene)
other("elimination", 3, scene)
other("metis-2", 1, scene, {"Discretisation/Partitioner": "METIS"})
# Newton's tolerance bounds what runs of different histories have in common.
other("adaptive", 2, adaptive, {**EVERY_4, RESIDUAL: 1e-11, GAP: 1e-11})
other("adaptive-2", 1, adaptive, {**EVERY_4, RESIDUAL: 1e-11, GAP: 1e-11})

# A finished run goes on to a later end.
start(fresh("later"), scene, {"Load stepping/End time": 1, STEPS: 4})
check(start("later", scene, resume=True), "later end")
later = Run("later", folder / "later", "")
same(Run("elimination", folder / "elimination", ""), later, 1e-10)
check(start("later", scene, resume=True), "a finished run resumed")
check(lasting("later") and later.figures() == Run("later", folder / "later", "").figures(),
      "a finished run resumed is another")


def refused(name, words, settings):
    """The message has these words, and the folder stays as it is."""
    def listing():
        return sorted((p.name, p.stat().st_size, p.stat().st_mtime_ns)
                      for p in (folder / "later").iterdir())

    before = listing()
    if start("later", scene, settings, resume=True):
        fail(f"{name} is not refused")
    elif not re.search(words, said("later")):
        fail(f"{name}: another message: {said('later')}")
    check(before == listing(), f"{name}: the folder has changed")


refused("modulus", "'Body base/Material', key 'Young modulus', value '999'.*value, '1000'",
        {"Body base/Material/Young modulus": 999})
refused("enforcement", "'Contact', key 'Enforcement', value 'penalty'.*'automatic'",
        {"Contact/Enforcement": "penalty"})
refused("end", "key 'End time', value '1'.*later time 1.5", {"Load stepping/End time": 1})
refused("partitioner", "key 'Partitioner'", {"Discretisation/Partitioner": "METIS"})
refused("pairs", "key 'Pairing', value 'pointwise'", {PAIRING: "pointwise"})
check(start("later", scene, {"Body base/Material/Young modulus": "1.0e3", "Title": "Other",
                             "Newton/Gap tolerance": 1e-9, **GMRES}, resume=True),
      "harmless changes are refused")
later.says("Linear solver/Type is now 'Belos GMRES', was 'automatic'")
fresh("nothing")
(folder / "nothing").mkdir()
check(not start("nothing", scene, resume=True), "resumed from nothing")
check(re.search("no complete checkpoint in the folder nothing.*Remedy: ", said("nothing"), re.S),
      "no remedy")

# Damage of any kind: the checkpoint before is taken.
DAMAGES = {
    "cut": ("piece_0.bin", lambda data: data[:len(data) // 2]),
    "empty": ("piece_0.bin", lambda data: b""),
    "lost": ("piece_0.bin", None),
    "contents": ("contents", None),
    "first": ("contents", lambda data: data[:40]),
    "last": ("contents", lambda data: data[:-2]),
    "byte": ("piece_0.bin", lambda data: data[:-9] + b"x" + data[-8:]),
}
for damage, (victim, change) in DAMAGES.items():
    shutil.copytree(folder / "elimination", folder / fresh("damaged"))
    path = checkpoints("damaged")[0] / victim
    if change:
        damaged = change(path.read_bytes())
        check(damaged != path.read_bytes(), f"{damage}: no damage")
        path.write_bytes(damaged)
    else:
        path.unlink()
    check(start("damaged", scene, EVERY_3, resume=True), f"damaged, {damage}: {said('damaged')}")
    log = Run("damaged", folder / "damaged", "").log
    check(re.search("^checkpoint checkpoint_000002 is skipped: ", log, re.M), f"{damage} is not told")
    check("goes on from checkpoint_000001: " in log, f"{damage}: another one")
    check(content(folder / "elimination/statistics") == content(folder / "damaged/statistics"),
          f"damaged, {damage}: another result")
for path in checkpoints("damaged"):
    (path / "contents").unlink()
check(not start("damaged", scene, resume=True), "resumed from damaged ones")
check(re.search("no complete checkpoint.*is skipped.*Remedy", said("damaged"), re.S),
      "no remedy for damage")

# kill -9 while a checkpoint is written, again and again: what is there in the end is complete,
# and the same as without. Each program must get one step further than the last.
MANY = {STEPS: 24, "Checkpoints/Steps between": 1, "Output/VTU interval": 0}
check(start(fresh("whole"), scene, MANY), "whole")
killed = folder / fresh("killed")
killed.mkdir()
(killed / "summary.json").write_text('{"converged": true}', encoding="utf-8")  # of an earlier run
in_the_middle = 0
for attempt in range(6):
    before = checkpoints("killed")[:1]
    command = [program, "--results-only", *settings_options(MANY), "--output", "killed",
               *(["--resume"] if attempt else []), scene]
    with processors(), subprocess.Popen(command, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL) as process:
        while process.poll() is None:
            parts = sorted(killed.glob("checkpoint_*.part"))
            if not parts:
                time.sleep(0)
                continue
            # Stopped, or the moment would be over before the rest is looked at.
            process.send_signal(signal.SIGSTOP)
            # In turn: at once, when the pieces are there, when all is there.
            wanted = ([], ["piece_0.bin"], ["piece_0.bin", "contents"])[attempt % 3]
            if checkpoints("killed")[:1] == before or \
                    not all((parts[0] / name).exists() for name in wanted):
                process.send_signal(signal.SIGCONT)
                continue
            process.kill()
            break
    check(process.returncode == 0 or not (killed / "summary.json").exists(), "killed: the summary of an earlier run is left")
    in_the_middle += any(killed.glob("checkpoint_*.part"))
print(f"killed 6 times, {in_the_middle} times in the middle of a checkpoint", flush=True)
check(in_the_middle > 0, "never killed in the middle of a checkpoint")
check(start("killed", scene, MANY, resume=True), f"killed: {said('killed')}")
check(content(folder / "whole/statistics") == content(killed / "statistics"),
      "killed and resumed: another result")
check(len(os.listdir(killed)) > 2 and len(list(killed.glob("checkpoint_*"))) == 2,
      "killed and resumed: unfinished checkpoints are left")
finish()
