# SPDX-License-Identifier: LGPL-2.1-or-later
"""Explicit dynamics: exact waves, the ledger, the same bits on any number of ranks and after a
restart, failures that end the run at once, and bending of one-point cells (doc/explicit.md)."""
# ctest: label = quick

import re
import shutil

from touchstone_test import (Run, below, check, checks, fail, finish, folder, launch, run,
                             settings_options)

column, blocks = checks / "explicit_column.prm", checks / "explicit_blocks.prm"

# A wave that has gone to and fro is where it was: one period at Courant factor 1.
period = run("column", column)
below("column after one period", period.error("displacement_max"), 1e-12)
below("ledger of the column", abs(period.value("motion", "energies", "balance_error")),
      1e-12 * period.value("motion", "energies", "initial"))


def start(name, settings=None, ranks=1, resume=False):
    """The blocks, with VTU files and checkpoints."""
    if not resume:
        shutil.rmtree(folder / name, ignore_errors=True)
    done = launch("--results-only", "--output", name, *(["--resume"] if resume else []),
                  *settings_options({"Output/VTU interval": 3, "Checkpoints/Steps between": 2,
                                     **(settings or {})}), blocks, ranks=ranks)
    check(done.returncode == 0, f"{name}: {done.stdout}")
    return Run(name, folder / name, done.stdout)


def bits(result):
    """Whatever the run has written of numbers: statistics, and results of summary.json."""
    return ((result.folder / "statistics").read_text(encoding="utf-8"),
            {key: result.summary.get(key) for key in ("motion", "results", "cycles", "errors")})


serial = start("blocks")
energies = serial.summary["motion"]["energies"]
below("ledger of the blocks", abs(energies["balance_error"]),
      0.01 * max(energies["kinetic"], energies["external"]))
for energy in "plastic", "viscous", "hourglass", "damping":
    check(energies[energy] > 0, f"no energy '{energy}'")
for ranks in 2, 3:
    parallel = start(f"blocks-{ranks}", ranks=ranks)
    check(bits(parallel) == bits(serial), f"other bits on {ranks} ranks")

# A run that was stopped after step 4 of 6 and resumed.
resumed = folder / "blocks-resumed"
shutil.rmtree(resumed, ignore_errors=True)
shutil.copytree(folder / "blocks", resumed)
newest = sorted(p for p in resumed.glob("checkpoint_[0-9]*") if p.suffix != ".part")[-1]
shutil.rmtree(newest)
(resumed / "summary.json").unlink()
again = start("blocks-resumed", resume=True)
again.says("goes on from checkpoint_")
check(bits(again) == bits(serial), "other bits after a restart")
finish()
