# SPDX-License-Identifier: LGPL-2.1-or-later
"""Phases of a run: their steps, names and numbers, implicit and explicit, and after a restart; an
overlap that is there in full before the end of the run."""
# ctest: goldens = phases, phases.mpirun=2
# ctest: label = quick

import shutil

from touchstone_test import below, check, finish, golden, launch, prm, relative, run, tests

scene = tests / "phases.prm"
ends = [0.5, 1, 1.4, 1.8, 2.2, 2.6, 3, 4]
pulled = golden("phases")
# At the end all forces are round-off; those of the phases before are compared.
for title in "floor: force x", "floor: force z":
    for one, two in zip(pulled.column(title), golden("phases", 2).column(title)):
        below(f"{title} on two ranks", abs(one - two) / 80, 1e-8)


def steps(result):
    """The steps are those of the three phases."""
    check(result.column("phase") == [1, 1, 2, 2, 2, 2, 2, 3], f"{result}: {result.column('phase')}")
    for time, end in zip(result.column("time"), ends):
        below(f"{result}: end of a step", abs(time - end), 1e-12)
    check(len(result.column("time")) == 8, f"{result}: {len(result.column('time'))} steps")
    check([phase["name"] for phase in result.summary["phases"]] == ["clamp", "pull", "release"],
          f"{result}: names of phases")


steps(pulled)
pulled.says("Step 3/8   t = 1.4   pull")
# Normal force E A w / h, and Coulomb's limit of it.
below("clamped", relative(pulled.column("floor: force z")[1], 80), 1e-8)
below("pulled", relative(abs(pulled.column("floor: force x")[6]), 0.3 * 80), 1e-8)
below("released", abs(pulled.column("floor: force z")[7]), 1e-9)

# From a checkpoint within the second phase.
run("resumed", scene, {"Checkpoints/Steps between": 4})
shutil.rmtree("resumed/checkpoint_000002")
done = launch("--results-only", "--resume", "--output", "resumed",
              "--set", "Checkpoints/Steps between=4", "--set", "Output/VTU interval=0", scene)
check(done.returncode == 0, f"resumed: {done.stdout}")
again = run("again", scene)
check((again.folder / "statistics").read_text(encoding="utf-8").splitlines()[-8:] ==
      open("resumed/statistics", encoding="utf-8").read().splitlines()[-8:], "resumed: other steps")
steps(run("explicit", scene, {"Time integration/Scheme": "central_differences",
                              "Body block/Material/Density": 0.01,
                              "Body block/Material/Rayleigh mass": 10}))

# The overlap is there in full half way, and stays.
fit = {"Body inner tube/Geometry/Cells": "4, 12, 1", "Body outer tube/Geometry/Cells": "4, 12, 1",
       "Contact pair fit/Sliding": "small", "Load stepping/Steps": 4}
full = run("full", prm / "press_fit.prm", fit).force("fit")[0]
ramped = run("ramped", prm / "press_fit.prm",
             {**fit, "Contact pair fit/Initial overlap": "ramp",
              "Contact pair fit/Overlap end time": 0.5}).column("fit: force x")
for force, part in zip(ramped, (0.5, 1, 1, 1)):
    below(f"part {part} of the overlap", relative(force, part * full), 1e-6)
finish()
