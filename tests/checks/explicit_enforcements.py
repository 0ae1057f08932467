# SPDX-License-Identifier: LGPL-2.1-or-later
"""Enforcements of explicit dynamics beside each other on two equal bars (doc/explicit.md, section
9.8, whose table this prints), and springs with friction on several ranks and after a restart."""

import math

from touchstone_test import (ENFORCEMENT, STEPS, Run, below, check, checks, finish, folder, launch,
                             lose_last_checkpoint, resume, run, settings_options)

bars = checks / "explicit_bars.prm"
COURANT, FACTOR = "Time integration/Courant factor", "Contact/Penalty factor"
SIX = (("forward increment", {}), ("defence node", {}), ("augmented lagrange", {}),
       ("soft penalty", {}), ("penalty", {}), ("penalty, factor 10", {FACTOR: 10}))


def launched(name, settings):
    """A run that may end with a reason."""
    done = launch("--results-only", "--output", folder / name, *settings_options(settings), bars)
    return Run(name, folder / name, done.stdout, done.returncode)


def two_bars(enforcement, settings, courant):
    """The bars with one cycle in each output interval: as many as a run in one interval has. Cells
    allow cycles of 1, and only 'penalty' shortens them."""
    settings = {ENFORCEMENT: enforcement.split(",")[0], COURANT: courant,
                "Load stepping/End time": 50, **settings}
    name = f"{enforcement} {courant}"
    cycles = math.ceil(50 / courant)
    if settings[ENFORCEMENT] == "penalty":
        once = launched(f"{name} once", {**settings, STEPS: 1})
        cycles = round(once.column("cycles")[0]) if once.code == 0 else 4 * cycles
    return launched(name, {**settings, STEPS: cycles})


def measures(result):
    """Error of the mean and scatter of the plateau, gain or loss of energy, time of opening,
    number of openings, cycles."""
    time, force = result.column("time"), [abs(f) for f in result.column("impact: force x")]
    plateau = [f for t, f in zip(time, force) if 5 < t < 35]
    mean = sum(plateau) / len(plateau)
    scatter = math.sqrt(sum((f - mean) ** 2 for f in plateau) / len(plateau))
    closed = [f > 0 for f in force]
    opened = [t for t, now, after in zip(time, closed, [*closed[1:], False]) if now and not after]
    energies = result.summary["motion"]["energies"]
    gain = -energies["contact"] / energies["initial"]
    return mean / 0.005 - 1, scatter / 0.005, gain, opened[-1], len(opened), len(time)


print(f"{'enforcement':20} Courant   plateau   scatter    energy   opens at   openings   cycles")
table = {}
for enforcement, settings in SIX:
    for courant in 1, 0.9, 0.5:
        result = two_bars(enforcement, settings, courant)
        if result.code != 0:
            check("gain energy" in result.text or "'Courant factor'" in result.text,
                  f"{result}: ends without a reason: {result.text}")
            print(f"{enforcement:20} {courant:7g}   ends: {result.summary['failure'][:60]}")
            continue
        mean, scatter, gain, opens, openings, cycles = table[enforcement, courant] = measures(result)
        print(f"{enforcement:20} {courant:7g}   {mean:+7.1e}   {scatter:7.1e}   {gain:+7.1e}"
              f"   {opens:8.2f}   {openings:8}   {cycles:6}", flush=True)
        below(f"{result}, energy gained", max(0, gain), 0.01)
for enforcement in "forward increment", "defence node", "augmented lagrange":
    mean, scatter, gain, opens, openings, cycles = table[enforcement, 1]
    below(f"{enforcement}, plateau", abs(mean), 1e-8)
    below(f"{enforcement}, scatter", scatter, 1e-8)
    check(gain <= 0 and openings == 1 and abs(opens - 40) < 1.5, f"{enforcement}: {opens}, {gain}")
# Springs of the usual factor 0.1 are so soft that bars of 20 cells part before the force has come to
# its plateau. Cycles are shorter only where springs by cells are stiff.
for enforcement, bound in ("soft penalty", 0.4), ("penalty", 0.4), ("penalty, factor 10", 0.01):
    below(f"{enforcement}, plateau", abs(table[enforcement, 0.9][0]), bound)
check(table["soft penalty", 0.9][5] == table["forward increment", 0.9][5],
      "soft penalty shortens the step")
check(table["penalty, factor 10", 0.9][5] > table["penalty", 0.9][5] >
      table["forward increment", 0.9][5], "penalty does not shorten the step")

# Springs keep the gap of the end of an interval: going on from it takes nothing from outside.
for enforcement in "penalty", "soft penalty":
    kept = run(f"{enforcement} kept", bars, {ENFORCEMENT: enforcement, COURANT: 0.9, STEPS: 5,
                                             "Load stepping/End time": 30})
    check(abs(kept.rows()[2]["impact: force x"]) > 0, f"{kept}: no force")
    below(f"{kept}, energy from outside",
          abs(kept.value("motion", "energies", "external")) /
          kept.value("motion", "energies", "initial"), 1e-12)


def resumes(name, scene, settings):
    """The run of the first of two checkpoints goes on to the same results."""
    first = run(name, scene, settings)
    statistics = (first.folder / "statistics").read_text(encoding="utf-8")
    lose_last_checkpoint(first.folder)
    resume(name, first.folder, scene, settings)
    check((first.folder / "statistics").read_text(encoding="utf-8") == statistics,
          f"{first}: other results after a restart")
    return first, statistics


# Springs with friction: the same bits on several ranks, and after a restart; of a block on a slope that
# is held by springs which have not slipped, whose elastic slip is their state.
corner = checks / "explicit_corner.prm"
for enforcement in "penalty", "soft penalty":
    settings = {ENFORCEMENT: enforcement, "Body block/Geometry/Cells": "2, 2, 2", STEPS: 10,
                "Load stepping/End time": 0.08,
                "Checkpoints/Steps between": 5}
    one, statistics = resumes(f"corner {enforcement}", corner, settings)
    check(one.value("motion", "energies", "friction") > 0, f"{one}: no friction")
    more = run(f"corner {enforcement} 3", corner, settings, 3)
    check((more.folder / "statistics").read_text(encoding="utf-8") == statistics,
          f"{one}: other results on 3 ranks")
    held, _ = resumes(f"slope {enforcement}", checks / "explicit_slope.prm",
                      {ENFORCEMENT: enforcement, STEPS: 4, "Load stepping/End time": 2,
                       "Checkpoints/Steps between": 2})
    check(abs(held.rows()[1]["contact: force x"]) > 0.1, f"{held}: nothing holds the block")
# Springs that are much too soft.
soft = run("much too soft", bars, {ENFORCEMENT: "penalty", FACTOR: 1e-4, STEPS: 10,
                                   "Body left/Initial velocity x": 0.2}, fails=True)
check("too soft" in soft.text, f"much too soft: {soft.text}")
finish()
