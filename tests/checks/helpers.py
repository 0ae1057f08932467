# SPDX-License-Identifier: LGPL-2.1-or-later
"""The helpers of the checks find what they are to find: touchstone_test.py on falsified results."""
# ctest: label = quick

import copy
import math
import pathlib
import shutil
import subprocess
import sys
import time

import touchstone_test as t

SUMMARY = {
    "converged": True, "iterations": {"newton": 7, "contact": 3, "damped": 0, "linear_total": 40,
                                      "linear_mean": 5.7},
    "results": {"contact": {"a pair": {"force": [1, 2, 1e-12], "moment": [0, 3, 4], "area": 2,
                                       "max_pressure": 5, "max_penetration": 1e-13, "active": 12}},
                "reactions": {"body": {"top": [-1, -2, 0]}}},
    "errors": {"pressure_l2": 1e-3}}


def result(change=lambda summary: None):
    run = t.Run("run", t.folder / "nothing", "")
    run.summary = copy.deepcopy(SUMMARY)
    change(run.summary)
    return run


def fails(what, function, *arguments, **keywords):
    """The helper must note a failure."""
    before = len(t._failures)  # pylint: disable=protected-access
    function(*arguments, **keywords)
    found = len(t._failures) > before  # pylint: disable=protected-access
    del t._failures[before:]  # pylint: disable=protected-access
    if not found:
        t.fail(f"not found: {what}")


def setter(value, *path):
    def change(summary):
        for key in path[:-1]:
            summary = summary[key]
        summary[path[-1]] = value
    return change


pair = "results", "contact", "a pair"
t.same(result(), result(), 1e-12, newton=True)
# Round-off of forces, penetrations, and iterations that do not count.
t.same(result(), result(setter(2e-12, *pair, "force", 2)), 1e-8)
t.same(result(), result(setter(1e-9, *pair, "max_penetration")), 1e-8)
t.same(result(), result(setter(8, "iterations", "newton")), 1e-8)
t.same(result(), result(setter(1e-3 + 1e-9, "errors", "pressure_l2")), 1e-8)
for what, change in (
        ("another force", setter(2.00001, *pair, "force", 1)),
        ("another reaction", setter(-1.00001, "results", "reactions", "body", "top", 0)),
        ("another moment", setter(4.00005, *pair, "moment", 2)),
        ("another area", setter(2.00001, *pair, "area")),
        ("another number of nodes", setter(13, *pair, "active")),
        ("another error", setter(2e-3, "errors", "pressure_l2")),
        ("no number", setter(None, *pair, "max_pressure")),
        ("a figure that is missing", lambda summary: summary["results"]["reactions"].clear()),
        ("nothing", lambda summary: summary.clear())):
    fails(what, t.same, result(), result(change), 1e-6)
    fails(what, t.same, result(change), result(), 1e-6)
fails("another number of iterations", t.same, result(), result(setter(8, "iterations", "newton")),
      1e-8, newton=True)
fails("another unit", t.same, result(), result(), 1e-6, moment=1e3)
t.same(result(), result(setter([0, 3e3, 4e3], *pair, "moment")), 1e-8, moment=1e3)

t.below("a small value", 1, 2)
for value in 2, 3, -1, math.nan, math.inf:
    fails(f"{value} is not below 2", t.below, "a value", value, 2)
fails("a missing figure", t.below, "a value", result().contact("another pair", "area"), 2)
fails("a run that fails", t.run, "no_scene", t.folder / "no_scene.prm")
fails("a run that does not fail", t.run, "runs", t.tests / "units_mm.prm", fails=True)
try:
    t.golden("units_mm")
    t.fail("a golden that is not declared is read")
except SystemExit as error:
    print(error)

# If who asks for a forked run is killed, as by a time limit, so is the run.
shutil.rmtree("killed", ignore_errors=True)
log = pathlib.Path("killed/log")
with subprocess.Popen([t.forking_program(), "--results-only", "--output", "killed", "--set", "Load stepping/Steps=100000",
                       "--set", "Output/VTU interval=0", t.tests / "units_mm.prm"]) as asks:
    end = time.monotonic() + 60
    while not (log.is_file() and "Step 2/" in log.read_text(encoding="utf-8")) and time.monotonic() < end:
        time.sleep(0.02)
    asks.kill()
time.sleep(0.5)
before = log.stat().st_size
time.sleep(0.5)
t.check(log.stat().st_size == before, "a run goes on without who asked for it")

# A check with a failure ends with exit code 1.
t.fail("on purpose")
try:
    t.finish()
    sys.exit("a failure does not count")
except SystemExit as error:
    if error.code != "1 check(s) failed":
        raise
